// SPDX-License-Identifier: Apache-2.0
// Tests properties that every fractal must have. They fail if the fractal's kernel source and descriptor do not agree.
// A separate build runs these tests with the fractal tests/fractals/sierpinski.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/instruments/trace.h"
#include "core/scene/fractal.h"
#include "core/scene/random_scene.h"
#include "flight/field/field.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

class EveryFractal : public testing::TestWithParam<const Fractal*> {
protected:
    const Fractal& fractal() const { return *GetParam(); }

    Image drawn(const Scene& scene, Mode mode, std::string_view without, Precision precision = Precision::f64) const
    {
        return render(*registry_.find("openmp"), scene,
                      {.precision = precision, .mode = mode, .techniques = techniques_without(without)});
    }

    std::vector<Scene> scenes() const
    {
        std::vector<Scene> all{official_scene(fractal(), 96, 72)};
        for (const NamedScene& named : random_scenes(8, 77)) {
            if (named.scene.fractal == &fractal()) all.push_back(named.scene);
        }
        return all;
    }

private:
    Registry registry_ = all_backends();
};

constexpr double most_off = 0.02;

// Returns the scene and the first differing pixel of two pictures, for messages.
std::string where(const Scene& scene, Mode mode, const Image& a, const Image& b)
{
    const std::int64_t first = std::max<std::int64_t>(compare(a, b).first, 0);
    return describe_pixel(a, b, first) + "; " + trace_command(scene, {.mode = mode}, first);
}

double share_off(const Image& a, const Image& b)
{
    const Comparison c = compare(a, b);
    return static_cast<double>(c.visibly_differing) / static_cast<double>(c.pixels);
}

TEST_P(EveryFractal, IsFoundByItsNames)
{
    EXPECT_EQ(&fractal_named(fractal().name), &fractal());
    EXPECT_EQ(&fractal_named(fractal().short_name), &fractal());
}

// The values of random and extreme scenes are within the ranges that parameter files allow. A file reads as the same
// scene.
TEST_P(EveryFractal, DrawsScenesInItsRanges)
{
    std::vector<Scene> all = scenes();
    for (int number = 0; number < 50; ++number) all.push_back(extreme_scene(fractal(), 3, number));
    for (const Scene& scene : all) {
        const std::string text = to_parameters(scene);
        const ParameterFile read = parse_parameters(text, "x.dat", fractal());
        EXPECT_EQ(to_parameters(read.scene), text);
        EXPECT_TRUE(read.warnings.empty()) << text;
        EXPECT_EQ(read.scene.eye.x, scene.eye.x);
        EXPECT_EQ(read.scene.shape, scene.shape);
    }
}

// The kernel's gradient must be that of its estimate. If normals are computed from finite differences of the estimate
// instead, the picture is nearly the same.
TEST_P(EveryFractal, GradientsAreThoseOfTheEstimate)
{
    const Scene scene = official_scene(fractal(), 96, 72);
    const Image by_gradient = drawn(scene, Mode::fast, "");
    const Image by_differences = drawn(scene, Mode::fast, "gradient");
    EXPECT_LT(share_off(by_gradient, by_differences), most_off)
        << where(scene, Mode::fast, by_gradient, by_differences);
}

// Negative control: the comparison of pictures detects slightly different light.
TEST_P(EveryFractal, OtherLightIsDetected)
{
    const Scene scene = official_scene(fractal(), 96, 72);
    Scene other = scene;
    other.brightness *= 1.1;
    EXPECT_GT(share_off(drawn(scene, Mode::fast, ""), drawn(other, Mode::fast, "gradient")), most_off);
}

// The hull does not cut off any surface: exact pictures with and without it are the same. unit/techniques_test.cpp has
// the negative control, a hull that is too small.
TEST_P(EveryFractal, HullChangesNoPicture)
{
    std::vector<NamedScene> all = random_scenes(40, 4711);
    for (NamedScene& scene : odd_scenes()) all.push_back(std::move(scene));
    for (const auto& [name, scene] : all) {
        if (scene.fractal != &fractal()) continue;
        for (const Precision precision : {Precision::f64, Precision::f32}) {
            const Image with = drawn(scene, Mode::exact, "", precision);
            const Image without = drawn(scene, Mode::exact, "hull", precision);
            EXPECT_TRUE(compare(with, without).same()) << name << ": " << where(scene, Mode::exact, with, without);
        }
    }
}

// Far outside the bounds that flights use, there is no surface: the estimate is positive. It is not larger than the
// distance to the centre.
TEST_P(EveryFractal, BodyHoldsTheFractal)
{
    const DistanceField field(official_scene(fractal(), 16, 9), 1);
    const double size = field.bounds().size;
    for (const Vector direction : {Vector{1, 0, 0}, Vector{0, -1, 0}, Vector{0.6, 0, 0.8}, Vector{-0.48, 0.6, -0.64}}) {
        const Vector p = 3 * size * direction;
        EXPECT_FALSE(field.bounds().contains(p));
        EXPECT_GT(field.distance(p), 0);
        EXPECT_LT(field.safety() * field.distance(p), 3 * size) << "the estimate at (" << p.x << ", " << p.y << ", "
                                                                << p.z << ") is larger than the distance to the centre";
    }
}

// At points that are equivalent by the fractal's symmetry, the estimates are the same.
TEST_P(EveryFractal, SymmetricPlacesAreAsFar)
{
    const DistanceField field(official_scene(fractal(), 16, 9), 1);
    const double size = field.bounds().size;
    for (const Vector direction : {Vector{0.9, 0.1, 0.3}, Vector{-0.2, 0.8, -0.5}, Vector{0.4, -0.7, 0.6}}) {
        const Vector p = 1.5 * size * direction;
        const double distance = field.distance(p);
        EXPECT_NEAR(field.distance(field.representative(p)), distance, 1e-6 * distance);
        EXPECT_TRUE(field.worth_searching(field.representative(p)));
    }
}

// Returns the largest ratio of an estimate to the distance from the sample to its ray's hit, which is on the surface.
// An estimate counts without its last tolerances, because the surface is only known to within these. Short steps find
// the first root on the ray.
std::pair<double, std::string> largest_estimate(Scene scene)
{
    constexpr double unknown = 4;  // tolerances
    scene.limits.step_factor = 0.1;
    const RendererOptions options{.mode = Mode::fast, .techniques = techniques_without("hull,relaxation")};
    std::pair<double, std::string> largest;
    for (int y = 3; y < scene.height; y += 9) {
        for (int x = 3; x < scene.width; x += 9) {
            const Trace ray = trace_pixel(scene, options, x, y);
            if (!ray.hit) continue;
            for (const TracedSample& sample : ray.marching) {
                const double left = ray.pixel.depth - sample.t;
                const double ratio = (sample.distance - unknown * sample.tolerance) / left;
                if (left > 0 && ratio > largest.first) {
                    largest = {ratio, fmt::format("at t = {}; {}", sample.t,
                                                  trace_command(scene, options, y * scene.width + x))};
                }
            }
        }
    }
    return largest;
}

// No ray hits the surface within the sphere that flights trust to be free (Trust::safety). Negative control: it would
// if the estimates were four times as large; those of the Mandelbulb and the Mandelbox, already 1.3 times.
TEST_P(EveryFractal, SafetyKeepsEstimatesBelowTheDistance)
{
    double worst = 0;
    for (Scene scene : scenes()) {
        for (const bool conservative : {false, true}) {
            scene.conservative = conservative;
            const auto [largest, where] = largest_estimate(scene);
            const double safe = fractal().flight.trust_of(scene).safety * largest;
            EXPECT_LE(safe, 1) << "times the distance, " << where;
            worst = std::max(worst, safe);
        }
    }
    EXPECT_GT(4 * worst, 1);
}

std::vector<const Fractal*> all_fractals()
{
    std::vector<const Fractal*> all;
    for (const Fractal& fractal : fractals()) all.push_back(&fractal);
    return all;
}

INSTANTIATE_TEST_SUITE_P(All, EveryFractal, testing::ValuesIn(all_fractals()),
                         [](const auto& one) { return std::string(one.param->short_name); });

}  // namespace
}  // namespace mandelmarch
