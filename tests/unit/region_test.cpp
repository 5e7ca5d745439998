// SPDX-License-Identifier: Apache-2.0
// The picture of a region has the same bits as the same part of the whole picture.
#include "core/render/region.h"

#include <gtest/gtest.h>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch {
namespace {

Image part_of(const Image& whole, const Region& region)
{
    Image crop_window(region.width, region.height, Image::Layers::all);
    for (int y = 0; y < region.height; ++y) {
        for (int x = 0; x < region.width; ++x) {
            const std::size_t from =
                Image::pixels(whole.width(), region.bottom + y) + static_cast<std::size_t>(region.left + x);
            const std::size_t to = Image::pixels(region.width, y) + static_cast<std::size_t>(x);
            for (std::size_t c = 0; c < 3; ++c) crop_window.bytes()[3 * to + c] = whole.bytes()[3 * from + c];
            crop_window.values()[to] = whole.values()[from];
        }
    }
    return crop_window;
}

class Regions : public testing::TestWithParam<std::string> {};

TEST_P(Regions, HaveTheBitsOfTheWholePicture)
{
    const Registry registry = all_backends();
    const Backend* backend = registry.find(GetParam());
    if (const auto why = backend->unavailable()) GTEST_SKIP() << *why;
    const bool host = GetParam() == "openmp";
    for (const Fractal& fractal : fractals()) {
        const Scene scene = official_scene(fractal, 75, 61);
        // Drivers take seconds to compile a fractal's kernel. Therefore they are tested with only the first fractal.
        if (!backend->draws(scene) || (!host && &fractal != &fractals().front())) continue;
        for (const Mode mode : {Mode::exact, Mode::fast}) {
            if (!host && mode == Mode::fast) continue;
            const auto renderer = backend->create({.precision = Precision::f64, .mode = mode});
            Image whole(scene.width, scene.height, Image::Layers::all);
            renderer->render(scene, whole);
            for (const Region region : {Region{0, 0, 75, 61}, {0, 17, 75, 20}, {9, 5, 40, 33}, {74, 60, 1, 1}}) {
                const auto [image, report] = render_region(*renderer, scene, region, Image::Layers::all);
                ASSERT_EQ(image.width(), region.width);
                const Image wanted = part_of(whole, region);
                const Comparison c = compare(image, wanted);
                // In fast pictures at most one pixel in a hundred may differ visibly.
                EXPECT_LE(100 * c.visibly_differing, c.pixels) << fractal.name << " " << name_of(mode);
                EXPECT_TRUE(c.same() || mode == Mode::fast)
                    << fractal.name << " " << region.left << "," << region.bottom << ": "
                    << describe_pixel(image, wanted, std::max<std::int64_t>(c.first, 0));
            }
        }
    }
}

// Returns the names of the backends that this build has.
std::vector<std::string> built(std::vector<std::string> names)
{
    const Registry registry = all_backends();
    std::erase_if(names, [&](const auto& name) { return registry.find(name)->info().build.compiler.empty(); });
    return names;
}

INSTANTIATE_TEST_SUITE_P(Of, Regions, testing::ValuesIn(built({"openmp", "reference", "opencl", "vulkan"})),
                         [](const auto& test) { return test.param; });

// Negative control: the picture of a region that is one pixel further right is different.
TEST(Region, OnePixelAsideDiffers)
{
    const Registry registry = all_backends();
    const Scene scene = official_scene(fractals().front(), 75, 61);
    const auto renderer = registry.find("openmp")->create({});
    const auto a = render_region(*renderer, scene, {20, 20, 30, 20}, Image::Layers::all).first;
    const auto b = render_region(*renderer, scene, {21, 20, 30, 20}, Image::Layers::all).first;
    EXPECT_FALSE(compare(a, b).same());
}

}  // namespace
}  // namespace mandelmarch
