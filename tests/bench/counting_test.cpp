// SPDX-License-Identifier: Apache-2.0
// Counted operations: against counts by hand, and against the work that a backend's own kernel reports.
#include "bench/counting.h"

#include <gtest/gtest.h>

#include "core/render/peak.h"
#include "tests/scenes.h"
#include "backends/all.h"

namespace mandelmarch::bench {
namespace {

// NOLINTNEXTLINE(cppcoreguidelines-avoid-non-const-global-variables): what the counting prelude counts into
thread_local Operations counter;

#define MM_REAL double
#define MM_REAL_IS_FLOAT 0
#define MM_OPERATIONS counter
namespace text {
#include "core/kernel/prelude/counting.h"
#include "core/kernel/vectors.h"
#include "core/kernel/peak.h"
#include "core/kernel/prelude/undefine.h"
}  // namespace text

template <class Body>
Operations counted(Body body)
{
    counter = {};
    body();
    return counter;
}

TEST(Counting, ByHand)
{
    const text::vec3 v = text::make_vec3(1, 2, 3);
    const Operations inner = counted([&] { text::inner(v, v); });
    EXPECT_EQ(inner.products, 3U);
    EXPECT_EQ(inner.sums, 2U);
    EXPECT_EQ(inner.total(), 5U);
    const Operations unit = counted([&] { text::unit(v); });
    EXPECT_EQ(unit.roots, 1U);
    EXPECT_EQ(unit.quotients, 3U);
    EXPECT_EQ(unit.total(), 9U);
    EXPECT_EQ(counted([&] { text::larger(v.x, v.y); }).total(), 0U) << "comparisons and picks are not counted";
    EXPECT_EQ(counted([&] { -v.x; }).total(), 0U);
}

// 9 sums to begin with, 9 to end with.
TEST(Counting, ThePeakDoesAsManyOperationsAsItIsCreditedWith)
{
    for (const int rounds : {0, 1, 7}) {
        const Operations all = counted([&] { text::multiply_add_chains(1, peak_factor, peak_addend, rounds); });
        EXPECT_EQ(static_cast<double>(all.total()), 18 + rounds * peak_operations_per_round);
        EXPECT_EQ(all.sums - 18, all.products);
    }
}

TEST(Counting, TheWorkIsThatOfABackend)
{
    const Registry registry = all_backends();
    for (const char* name : {"bulb", "box"}) {
        for (const Mode mode : {Mode::exact, Mode::fast}) {
            for (const Precision precision : {Precision::f64, Precision::f32}) {
                const Scene scene = official_scene(name, 61, 45);
                const Count count = count_operations(scene, {.precision = precision, .mode = mode});
                Image image(scene.width, scene.height, Image::Layers::bytes);
                const auto renderer =
                    registry.find("openmp")->create({.precision = precision, .mode = mode, .pack = 1});
                const Work work = renderer->render(scene, image).work;
                EXPECT_EQ(count.pixels, image.pixels());
                // Contraction moves a step here and there in fast mode.
                const double allowed = mode == Mode::exact ? 0 : 0.005 * static_cast<double>(work.iterations);
                EXPECT_NEAR(static_cast<double>(count.work.iterations), static_cast<double>(work.iterations), allowed);
                EXPECT_NEAR(static_cast<double>(count.work.estimates), static_cast<double>(work.estimates), allowed);
                EXPECT_NEAR(static_cast<double>(count.work.steps), static_cast<double>(work.steps), allowed);
            }
        }
    }
}

// The stages: refining only in fast mode, the march the most, and a part of a picture stands for all of it.
TEST(Counting, StagesAndSampling)
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
    const Count part = count_operations(scene, {.mode = Mode::exact, .most_pixels = 3000});
    EXPECT_LT(part.pixels, 4000U);
    EXPECT_NEAR(part.per_iteration() / exact.per_iteration(), 1, 0.02);
}

TEST(Counting, Lanes)
{
    const Scene scene = official_scene("box", 96, 96);
    const Count count = count_operations(scene, {.lanes = {1, 16, 32, 64}});
    ASSERT_EQ(count.lane_use.size(), 4U);
    EXPECT_EQ(count.lane_use[0].together.in_steps, 1);
    EXPECT_EQ(count.lane_use[0].together.in_iterations, 1);
    for (std::size_t i = 1; i < count.lane_use.size(); ++i) {
        const LaneUse& use = count.lane_use[i];
        EXPECT_LT(use.together.in_steps, count.lane_use[i - 1].together.in_steps);
        EXPECT_LT(use.together.in_iterations, use.together.in_steps);
        EXPECT_GT(use.refilled->in_steps, use.together.in_steps);
        EXPECT_GT(use.refilled->in_iterations, use.together.in_iterations);
    }
}

// Two lanes, rays of three, one, two and no steps. Together: 3 + 2 steps of both lanes, (9 + 1 + 1) + (5 + 5)
// iterations of the slowest. Refilled: the second lane takes the third ray after its first step, and 9 + 5 + 5 are the
// slowest.
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
    LaneCount twice(2);
    twice.add(count);
    twice.add(count);
    EXPECT_DOUBLE_EQ(twice.use().refilled->in_iterations, use.refilled->in_iterations);
}

// Of a power that is not whole the angles are computed: many more operations for the same iterations.
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
