// SPDX-License-Identifier: Apache-2.0
// Distance fields give the same bits on any number of threads and with every instruction set.
#include "flight/field/field.h"

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <set>
#include <thread>
#include <vector>

#include "core/scene/fractal.h"
#include "flight/field/threads.h"
#include "hwy/highway.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

std::vector<Vector> places(int count)
{
    std::vector<Vector> places;
    for (int i = 0; i < count; ++i) places.push_back({std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.31)});
    return places;
}

// Returns, as bits, the distances at points and the ends of rays. For each point, a ray starts twice as far from the
// middle as the point and goes towards the middle.
std::vector<std::uint64_t> bits_of(const DistanceField& field)
{
    const std::vector<Vector> points = places(1001);  // not a multiple of a pack
    std::vector<Vector> from;
    std::vector<Vector> along;
    for (const Vector& p : points) {
        from.push_back(2 * p);
        along.push_back(unit(Vector{} - p));
    }
    std::vector<double> distances(points.size());
    std::vector<double> ends(points.size());
    field.distances(points, distances);
    field.casts(from, along, {.floor = 1e-6, .tolerance = 1e-4, .end = 4, .steps = 200}, ends);
    std::vector<std::uint64_t> bits;
    for (const double value : distances) bits.push_back(std::bit_cast<std::uint64_t>(value));
    for (const double value : ends) bits.push_back(std::bit_cast<std::uint64_t>(value));
    return bits;
}

// Each part of the outer loop waits for a moment, so that no thread runs all parts. Negative control: the outer loop
// runs on several threads.
TEST(Threads, LoopInALoopRunsOnOneThread)
{
    std::vector<std::thread::id> outer(8);
    std::vector<std::thread::id> inner(64);
    parallel(8, 1, 4, [&](std::size_t first, std::size_t last) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        for (std::size_t i = first; i < last; ++i) {
            outer[i] = std::this_thread::get_id();
            parallel(8, 1, 4, [&](std::size_t from, std::size_t to) {
                for (std::size_t j = from; j < to; ++j) inner[8 * i + j] = std::this_thread::get_id();
            });
        }
    });
    for (std::size_t k = 0; k < inner.size(); ++k) EXPECT_EQ(inner[k], outer[k / 8]) << k;
    EXPECT_GT(std::set(outer.begin(), outer.end()).size(), 1U);
}

// Lanes take new rays while others march. The rays end after different numbers of steps, some of them at the limit.
TEST(DistanceField, ARayHasTheSameLengthAloneAndAmongOthers)
{
    for (const char* name : {"bulb", "box"}) {
        const DistanceField field(official_scene(name, 16, 9), 1);
        std::vector<Vector> from;
        std::vector<Vector> along;
        for (const Vector& p : places(700)) {
            from.push_back(4 * p);
            along.push_back(unit(Vector{0.3, 0.2, 0.1} - p));
        }
        const field::Reach reach{.floor = 1e-6, .tolerance = 1e-4, .end = 8, .steps = 20};
        std::vector<double> together(from.size());
        field.casts(from, along, reach, together);
        std::set<double> lengths;
        for (std::size_t i = 0; i < from.size(); ++i) {
            double alone = 0;
            field.casts({&from[i], 1}, {&along[i], 1}, reach, {&alone, 1});
            EXPECT_EQ(together[i], alone) << name << ", ray " << i;
            lengths.insert(alone);
        }
        EXPECT_GT(lengths.size(), 200) << name;
    }
}

TEST(DistanceField, TheSameBitsInEveryInstructionSet)
{
    for (const char* name : {"bulb", "box", "julia"}) {
        const Scene scene = official_scene(name, 16, 9);
        const std::vector<std::uint64_t> expected = bits_of(DistanceField(scene, 1));
        std::set<int> lanes;
        for (const std::int64_t target : {HWY_STATIC_TARGET, HWY_SSE4, HWY_AVX2, HWY_AVX3}) {
            hwy::SetSupportedTargetsForTest(0);
            if ((hwy::SupportedTargets() & target) == 0) continue;  // the machine lacks these instructions
            hwy::SetSupportedTargetsForTest(target);
            lanes.insert(field::kernel_of(scene.fractal->name).lanes);
            EXPECT_EQ(bits_of(DistanceField(scene, 1)), expected) << name << ", " << hwy::TargetName(target);
        }
        hwy::SetSupportedTargetsForTest(0);
        // The loop has tested both the scalar kernel, which has one lane, and packs.
        EXPECT_TRUE(lanes.contains(1));
        EXPECT_GT(lanes.size(), 1U);
        // Negative control: the bits differ for a scene whose shape differs by a millionth.
        Scene other = scene;
        other.shape[0] += 1e-6;
        other.shape[2] += 1e-6;
        EXPECT_NE(bits_of(DistanceField(other, 1)), expected) << name;
    }
}

}  // namespace
}  // namespace mandelmarch
