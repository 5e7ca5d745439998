// SPDX-License-Identifier: Apache-2.0
// Operation counts must equal counts made by hand and the work counts that a backend reports.
#include "bench/counting/counting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "backends/all.h"
#include "bench/measure/views.h"
#include "core/render/peak.h"
#include "tests/scenes.h"

namespace mandelmarch::bench {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): counter of the counting prelude
thread_local Operations counted_operations;

#define MM_REAL double
#define MM_REAL_IS_FLOAT 0
#define MM_OPERATIONS counted_operations
namespace text {
#include "core/kernel/prelude/counting.h"
#include "core/kernel/vectors.h"
#include "core/kernel/peak.h"
#include "core/kernel/prelude/undefine.h"
}  // namespace text

template <class Body>
Operations counted(Body body)
{
    counted_operations = {};
    body();
    return counted_operations;
}

TEST(Counting, ByHand)
{
    const text::vec3 v = text::make_vec3(1, 2, 3);
    const Operations dot = counted([&] { text::dot3(v, v); });
    EXPECT_EQ(dot.multiplications, 3U);
    EXPECT_EQ(dot.additions, 2U);
    EXPECT_EQ(dot.total(), 5U);
    const Operations unit = counted([&] { text::unit(v); });
    EXPECT_EQ(unit.square_roots, 1U);
    EXPECT_EQ(unit.divisions, 3U);
    EXPECT_EQ(unit.total(), 9U);
    EXPECT_EQ(counted([&] { text::larger(v.x, v.y); }).total(), 0U) << "comparisons and picks are not counted";
    EXPECT_EQ(counted([&] { -v.x; }).total(), 0U);
}

// multiply_add_chains() does 18 additions that belong to no round: 9 before the first round and 9 after the last.
TEST(Counting, PeakKernelHasTheOperationsOfItsRate)
{
    for (const int rounds : {0, 1, 7}) {
        const Operations all = counted([&] { text::multiply_add_chains(1, peak_factor, peak_addend, rounds); });
        EXPECT_EQ(static_cast<double>(all.total()), 18 + rounds * peak_operations_per_round);
        EXPECT_EQ(all.additions - 18, all.multiplications);
    }
}

TEST(Counting, WorkIsThatOfABackend)
{
    const Registry registry = all_backends();
    for (const char* name : {"bulb", "box"}) {
        for (const Mode mode : {Mode::exact, Mode::fast}) {
            for (const Precision precision : {Precision::f64, Precision::f32}) {
                const Scene scene = official_scene(name, 61, 45);
                const Count count = count_operations(scene, {.precision = precision, .mode = mode});
                Image image(scene.width, scene.height, Image::Layers::bytes);
                const auto renderer =
                    registry.find("openmp")->create({.precision = precision, .mode = mode, .simd_width = 1});
                const Work work = renderer->render(scene, image).work;
                EXPECT_EQ(count.pixels, image.pixels());
                // In fast mode the backend's kernel may fuse operations, which adds or removes a few steps.
                const double allowed = mode == Mode::exact ? 0 : 0.005 * static_cast<double>(work.iterations);
                EXPECT_NEAR(static_cast<double>(count.work.iterations), static_cast<double>(work.iterations), allowed);
                EXPECT_NEAR(static_cast<double>(count.work.de_calls), static_cast<double>(work.de_calls), allowed);
                EXPECT_NEAR(static_cast<double>(count.work.steps), static_cast<double>(work.steps), allowed);
            }
        }
    }
}

// Only fast mode has operations in the stage `refine`. In exact mode most operations are in the stage `march`.
TEST(Counting, OnlyFastModeRefines)
{
    const Scene scene = official_scene("box", 160, 120);
    const auto of = [](const Count& count, Stage stage) {
        return count.stages.at(static_cast<std::size_t>(stage)).total();
    };
    const Count exact = count_operations(scene, {.mode = Mode::exact});
    const Count fast = count_operations(scene, {.mode = Mode::fast});
    EXPECT_EQ(of(exact, Stage::refine), 0U);
    EXPECT_GT(of(fast, Stage::refine), 0U);
    EXPECT_GT(2 * of(exact, Stage::march), exact.all().total());
    EXPECT_GT(of(exact, Stage::normal), of(exact, Stage::shade));
    EXPECT_GT(exact.hits, 0U);
}

// Of a picture with many pixels, evenly spread blocks are counted. Their operations of an iteration are nearly those of
// the picture. Negative control: another view has other ones.
TEST(Counting, SpreadBlocksHaveThePicturesOperationsOfAnIteration)
{
    const std::vector<View> views = views_of("bulb", 272, 136);
    const Scene& scene = views.front().scene;
    const Count whole = count_operations(scene, {});
    const Count part = count_operations(scene, {.most_pixels = 4096});
    EXPECT_EQ(whole.pixels, 272U * 136);
    EXPECT_NEAR(static_cast<double>(part.pixels), 4096, 512);
    EXPECT_NEAR(part.per_iteration() / whole.per_iteration(), 1, 0.01);
    EXPECT_NEAR(part.lane_use[0].together.in_steps / whole.lane_use[0].together.in_steps, 1, 0.05);
    const Scene& far = std::ranges::find(views, "far", &View::name)->scene;
    EXPECT_GT(std::abs(count_operations(far, {}).per_iteration() / whole.per_iteration() - 1), 0.01);
}

// A vector has two lanes. Four rays take three, one, two and no steps; `rays` has the iterations of each step.
// Without refill, the first two rays take 3 steps of the vector, in which the slower lane has 9 + 1 + 1 iterations. The
// other two rays then take 2 steps, with 5 + 5 iterations.
// With refill, the second lane takes the third ray after its first step. The vector takes 3 steps, in which the slower
// lane has 9 + 5 + 5 iterations.
TEST(Counting, LanesByHand)
{
    const std::vector<RaySteps> rays{{4, 1, 1}, {9}, {5, 5}, {}};
    LaneCount count(2);
    count.add(rays);
    const LaneUse use = count.use();
    EXPECT_EQ(use.lanes, 2);
    EXPECT_DOUBLE_EQ(use.together.in_steps, 6.0 / 10);
    EXPECT_DOUBLE_EQ(use.together.in_iterations, 25.0 / (2 * 21));
    EXPECT_DOUBLE_EQ(use.refilled->in_steps, 6.0 / 6);
    EXPECT_DOUBLE_EQ(use.refilled->in_iterations, 25.0 / (2 * 19));
    LaneCount twice = count;
    twice.add(count);
    EXPECT_DOUBLE_EQ(twice.use().refilled->in_iterations, use.refilled->in_iterations);
}

// A power that is not an integer is computed with trigonometric functions. The picture then has about the same number
// of iterations, but each iteration has more than twice as many operations.
TEST(Counting, TrigonometryCosts)
{
    Scene scene = official_scene("bulb", 64, 64);
    const Count plain = count_operations(scene, {});
    scene.shape[2] += 1e-5;
    const Count angles = count_operations(scene, {});
    EXPECT_GT(angles.per_iteration(), 2 * plain.per_iteration());
    EXPECT_NEAR(static_cast<double>(angles.work.iterations) / static_cast<double>(plain.work.iterations), 1, 0.02);
}

}  // namespace
}  // namespace mandelmarch::bench
