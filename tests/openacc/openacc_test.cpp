// SPDX-License-Identifier: Apache-2.0
// OpenACC draws the bits of the scalar text, on a GPU where there is one and else on the host, and says where it runs.
#include <gtest/gtest.h>

#include "backends/all.h"
#include "core/base/error.h"
#include "core/image/compare.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

class Openacc : public testing::TestWithParam<Precision> {
protected:
    const Registry registry = all_backends();
    const Backend& openacc = *registry.find("openacc");
    const Backend& openmp = *registry.find("openmp");

    static std::vector<NamedScene> scenes()
    {
        std::vector<NamedScene> all = odd_scenes();
        for (const char* fractal : {"bulb", "box"}) {
            all.push_back({fractal, official_scene(fractal, 270, 270)});
            all.push_back({"one pixel", official_scene(fractal, 1, 1)});
            all.push_back({"six pixels", official_scene(fractal, 3, 2)});
            all.push_back({"one column", official_scene(fractal, 1, 201)});
            all.push_back({"one row", official_scene(fractal, 20000, 1)});  // wider than a band on the host
        }
        return all;
    }
};

TEST_P(Openacc, ExactHasTheBitsOfTheScalarText)
{
    for (const auto& [name, scene] : scenes()) {
        const Image expected = render(openmp, scene, {.precision = GetParam(), .pack = 1});
        const Image image = render(openacc, scene, {.precision = GetParam()});
        const Comparison difference = compare(expected, image);
        EXPECT_TRUE(difference.same()) << name << ": "
                                       << describe_pixel(expected, image, std::max<std::int64_t>(0, difference.first));
    }
}

// The twin: another mode has other bits.
TEST_P(Openacc, FastDiffersFromExactAndIsTheCanonicalPicture)
{
    for (const char* fractal : {"bulb", "box"}) {
        const Scene scene = official_scene(fractal, 100, 100);
        const Image image = render(openacc, scene, {.precision = GetParam(), .mode = Mode::fast});
        EXPECT_FALSE(compare(render(openacc, scene, {.precision = GetParam()}), image).same());
        const Image canonical = render(*registry.find("reference"), scene, {.mode = Mode::fast});
        EXPECT_LE(compare(canonical, image).visibly_differing, 10000U * 2 / 100) << fractal;
    }
}

TEST_P(Openacc, ReportsWhereItRanAndItsWork)
{
    const Scene scene = official_scene("box", 200, 150);
    const RendererOptions options{.precision = GetParam()};
    Image image(scene.width, scene.height, Image::Layers::bytes);
    const RenderReport report = openacc.create(options)->render(scene, image);
    EXPECT_EQ(report.device.name, openacc.devices().front().name);
    EXPECT_EQ(report.precision, GetParam());
    const Timings& t = report.timings;
    EXPECT_GT(t.kernel, 0);
    EXPECT_LE(t.upload + t.kernel + t.readback, t.wall);
    const Work expected = openmp.create({.precision = GetParam(), .pack = 1})->render(scene, image).work;
    EXPECT_EQ(report.work.steps, expected.steps);
    EXPECT_EQ(report.work.estimates, expected.estimates);
    EXPECT_EQ(report.work.iterations, expected.iterations);
}

INSTANTIATE_TEST_SUITE_P(Precisions, Openacc, testing::Values(Precision::f64, Precision::f32),
                         [](const auto& test) { return std::string(name_of(test.param)); });

TEST(OpenaccDevices, TheHostIsLastAndSaysThatItIsNoGpu)
{
    const Registry registry = all_backends();
    const Backend& openacc = *registry.find("openacc");
    const std::vector<Device> devices = openacc.devices();
    ASSERT_FALSE(devices.empty());
    EXPECT_FALSE(devices.back().is_gpu);
    EXPECT_EQ(devices.back().name.find("host, one thread"), 0U);
    for (std::size_t i = 0; i + 1 < devices.size(); ++i) EXPECT_TRUE(devices[i].is_gpu);
    const int missing = static_cast<int>(devices.size());
    EXPECT_THROW(openacc.create({.device = missing}), Unavailable);
    // `auto` never takes the host through OpenACC.
    EXPECT_EQ(registry.automatic().backend->name(), devices.front().is_gpu ? "openacc" : "openmp");
}

}  // namespace
}  // namespace mandelmarch
