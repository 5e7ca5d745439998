// SPDX-License-Identifier: Apache-2.0
// A traced pixel equals the picture's pixel, and the steps of the trace lead to this pixel.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "backends/all.h"
#include "core/instruments/trace.h"
#include "core/scene/fractal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

bool same_double(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same_pixel(const Image& image, std::size_t index, const Trace& trace)
{
    const PixelValue& a = image.values()[index];
    const PixelValue& b = trace.pixel;
    return same_double(a.red, b.red) && same_double(a.green, b.green) && same_double(a.blue, b.blue) &&
           same_double(a.depth, b.depth) && a.steps == b.steps && a.iterations == b.iterations &&
           std::equal(trace.bytes.begin(), trace.bytes.end(), image.bytes().begin() + static_cast<long>(3 * index));
}

std::vector<NamedScene> small_scenes()
{
    std::vector<NamedScene> scenes = odd_scenes();
    for (const Fractal& fractal : fractals()) {
        scenes.push_back({std::string(fractal.name), official_scene(std::string(fractal.short_name), 40, 30)});
    }
    for (NamedScene& named : scenes) {
        named.scene.width = 40;
        named.scene.height = 30;
    }
    return scenes;
}

class Traces : public testing::TestWithParam<Precision> {
protected:
    RendererOptions options(Mode mode) const { return {.precision = GetParam(), .mode = mode, .simd_width = 1}; }
};

TEST_P(Traces, HaveTheBitsOfTheExactPicture)
{
    int hits = 0;
    for (const auto& [name, scene] : small_scenes()) {
        const Image image = render(*make_openmp_backend(), scene, options(Mode::exact));
        for (std::size_t i = 7; i < image.pixels(); i += 61) {
            const int x = static_cast<int>(i) % scene.width;
            const int y = static_cast<int>(i) / scene.width;
            const Trace trace = trace_pixel(scene, options(Mode::exact), x, y);
            EXPECT_TRUE(same_pixel(image, i, trace)) << name << " " << x << "," << y << "\n" << text_of(trace);
            hits += static_cast<int>(trace.hit);
        }
    }
    EXPECT_GT(hits, 50);
}

TEST_P(Traces, OfAnotherPixelDiffer)
{
    const Scene scene = official_scene("bulb", 40, 30);
    const Image image = render(*make_openmp_backend(), scene, options(Mode::exact));
    EXPECT_TRUE(same_pixel(image, 15 * 40 + 20, trace_pixel(scene, options(Mode::exact), 20, 15)));
    EXPECT_FALSE(same_pixel(image, 15 * 40 + 20, trace_pixel(scene, options(Mode::exact), 21, 15)));
}

// Each sample of a trace lies at the position to which the previous sample leads. The last sample decides whether the
// ray hits.
TEST_P(Traces, HaveStepsThatLeadToTheResult)
{
    for (const Mode mode : {Mode::exact, Mode::fast}) {
        for (const auto& [name, scene] : small_scenes()) {
            const Trace trace = trace_pixel(scene, options(mode), 19, 14);
            const auto& samples = trace.marching;
            ASSERT_EQ(samples.size(), static_cast<std::size_t>(trace.pixel.steps)) << name;
            for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_EQ(samples[i].t, samples[i - 1].next) << name;
            const bool hit = !samples.empty() && samples.back().decision == Decision::hit;
            EXPECT_EQ(trace.hit, hit) << name << "\n" << text_of(trace);
            EXPECT_EQ(trace.normal.has_value(), hit) << name;
        }
    }
}

// The search for a canonical hit brackets the root ever more closely. Therefore the last position in the trace is near
// the root.
TEST_P(Traces, OfFastPicturesShowTheRootsTried)
{
    const Trace trace = trace_pixel(official_scene("bulb", 40, 30), options(Mode::fast), 20, 15);
    ASSERT_TRUE(trace.hit);
    ASSERT_FALSE(trace.refining.empty());
    EXPECT_EQ(trace.refined, Refined::close);
    const TracedSample& last = trace.refining.back();
    EXPECT_LT(std::abs(last.distance - last.tolerance), 0.1 * last.tolerance);
    EXPECT_LT(std::abs(last.t - trace.pixel.depth), last.tolerance);
}

INSTANTIATE_TEST_SUITE_P(Precisions, Traces, testing::Values(Precision::f64, Precision::f32),
                         [](const auto& tested) { return std::string(name_of(tested.param)); });

}  // namespace
}  // namespace mandelmarch
