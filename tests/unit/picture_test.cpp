// SPDX-License-Identifier: Apache-2.0
// Pictures are compared with those of the original program and of the reference, and pictures in float with pictures in
// double. tests/equivalence tests fast pictures of the official scenes.
#include <gtest/gtest.h>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/image/formats/image_file.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

class Picture : public testing::TestWithParam<const char*> {
protected:
    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");
    const Backend& reference = *registry.find("reference");
    const Scene scene = official_scene(GetParam(), 270, 270);
    const bool bulb = GetParam() == std::string("bulb");

    Image original() const
    {
        return read_image(std::string(MANDELMARCH_SOURCE_DIR) + "/tests/reference/" + GetParam() + "_270.png");
    }
    // Returns the number of visibly different pixels per hundred thousand pixels.
    static std::uint64_t share(const Comparison& c) { return c.visibly_differing * 100'000 / c.pixels; }
};

TEST_P(Picture, ExactDoubleIsTheOriginals)
{
    for (const Backend* backend : {&openmp, &reference}) {
        EXPECT_LE(compare(render(*backend, scene, {}), original()).visibly_differing, bulb ? 2U : 0U)
            << backend->name();
    }
}

// Negative control: with 4 iterations the picture differs from the original one by far more than is allowed.
TEST_P(Picture, AnotherSceneIsNotTheOriginals)
{
    Scene other = scene;
    other.iterations = 4;
    EXPECT_GT(compare(render(openmp, other, {}), original()).visibly_differing, 1000U);
}

TEST_P(Picture, FloatIsCloseToDouble)
{
    const Image exact = render(openmp, scene, {});
    const Image single = render(openmp, scene, {.precision = Precision::f32});
    EXPECT_LE(share(compare(exact, single)), bulb ? 100U : 1000U);
}

TEST_P(Picture, MissesAreInfinitelyFarAndGrey)
{
    const Image image = render(openmp, scene, {});
    const PixelValue& corner = image.values().front();
    EXPECT_TRUE(std::isinf(corner.depth));
    EXPECT_EQ(corner.red, 0.4);
    EXPECT_EQ(image.bytes()[0], 102);
}

INSTANTIATE_TEST_SUITE_P(Official, Picture, testing::Values("bulb", "box"),
                         [](const auto& test) { return std::string(test.param); });

TEST(OddScenes, OpenmpDrawsWhatTheReferenceDraws)
{
    const Registry registry = all_backends();
    for (const auto& [name, scene] : odd_scenes()) {
        if (!registry.find("reference")->draws(scene)) continue;
        const Image expected = render(*registry.find("reference"), scene, {});
        const Image image = render(*registry.find("openmp"), scene, {});
        const Comparison c = compare(expected, image);
        EXPECT_LE(c.visibly_differing, 1 + c.pixels / 500)
            << name << ": " << describe_pixel(expected, image, std::max<std::int64_t>(0, c.first));
    }
}

NamedScene random_scene(unsigned seed, const std::string& name)
{
    for (NamedScene& named : random_scenes(60, seed)) {
        if (named.name == name) return named;
    }
    ADD_FAILURE() << name;
    return {};
}

// The eye is 5e-7 in front of the surface. From there, relief is visible that the original program's finite differences
// are too wide to resolve. If the reference computed its normals from differences of that width, half of the pixels
// would be wrong.
TEST(CanonicalReference, ShowsReliefFinerThanTheOriginalsDifferences)
{
    const Registry registry = all_backends();
    const Scene scene = random_scene(3003, "box, random 42").scene;
    const Image canonical = render(*registry.find("reference"), scene, {.mode = Mode::fast});
    const Image fast = render(*registry.find("openmp"), scene, {.mode = Mode::fast});
    EXPECT_LE(50 * compare(canonical, fast).visibly_differing, fast.pixels());
    const Image wide = render(*registry.find("openmp"), scene, {.mode = Mode::fast, .techniques = {.gradient = false}});
    EXPECT_GT(10 * compare(canonical, wide).visibly_differing, wide.pixels());
}

// If the eye is inside the solid, there is no visible surface, and the gradient of the estimate may be noise. The
// normal in canonical pictures is then the direction towards the eye.
TEST(EyeInTheSolid, NormalsOfCanonicalPicturesFaceIt)
{
    const Registry registry = all_backends();
    Scene bulb = official_scene("bulb", 47, 33);
    bulb.eye = {0.1, 0.2, 0.1};
    for (const Scene& scene : {random_scene(1001, "box, random 20").scene, bulb}) {
        const Image canonical = render(*registry.find("reference"), scene, {.mode = Mode::fast});
        for (const PixelValue& pixel : canonical.values()) ASSERT_EQ(pixel.depth, 0);
        for (const Precision precision : {Precision::f64, Precision::f32}) {
            const auto drawn = [&](Mode mode) {
                return render(*registry.find("openmp"), scene, {.precision = precision, .mode = mode});
            };
            EXPECT_EQ(compare(canonical, drawn(Mode::fast)).visibly_differing, 0U) << name_of(precision);
            EXPECT_GT(50 * compare(canonical, drawn(Mode::exact)).visibly_differing, canonical.pixels());
        }
    }
}

// The kernel limits the escape radius. If it did not, gradients in float would overflow with a radius of 1000, in 1.5 %
// of the pixels.
TEST(Bailout, AnyRadiusFitsAFloat)
{
    const Registry registry = all_backends();
    Scene scene = official_scene("bulb", 200, 200);
    scene.shape[1] = 1000;
    for (const Mode mode : {Mode::exact, Mode::fast}) {
        const Image wide = render(*registry.find("openmp"), scene, {.mode = mode});
        const Image narrow = render(*registry.find("openmp"), scene, {.precision = Precision::f32, .mode = mode});
        EXPECT_LE(compare(wide, narrow).visibly_differing, 100U) << name_of(mode);
    }
}

}  // namespace
}  // namespace mandelmarch
