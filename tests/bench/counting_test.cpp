// SPDX-License-Identifier: Apache-2.0
// Operation counts must equal counts made by hand and the work counts that a backend reports.
#include "bench/counting/counting.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "bench/measure/views.h"
#include "core/render/peak.h"
#include "tests/scenes.h"
#include "backends/all.h"

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
TEST(Counting, ThePeakDoesAsManyOperationsAsItIsCreditedWith)
{
    for (const int rounds : {0, 1, 7}) {
        const Operations all = counted([&] { text::multiply_add_chains(1, peak_factor, peak_addend, rounds); });
        EXPECT_EQ(static_cast<double>(all.total()), 18 + rounds * peak_operations_per_round);
        EXPECT_EQ(all.additions - 18, all.multiplications);
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
TEST(Counting, Stages)
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

// A quantity measured on a picture: its estimate from a sample of the pixels, the standard error of the estimate, and
// the true value from all pixels.
struct Figure {
    std::string what;
    double sampled, error, truth;

    double relative_error() const { return error / truth; }
    // Returns the difference between the estimate and the true value, as a multiple of the standard error.
    double off() const { return std::abs(sampled - truth) / error; }
};

using Choose = std::function<Count(const Scene& scene)>;

// Returns the quantities of exact pictures in double: three views of each of two fractals. `sample` counts the
// operations of the pixels that it chooses.
std::vector<Figure> sampled_figures(const Choose& sample)
{
    const auto per_estimate = [](const Count& count) {
        return static_cast<double>(count.march_iterations) / static_cast<double>(count.march_estimates);
    };
    std::vector<Figure> figures;
    for (const char* fractal : {"bulb", "box"}) {
        for (const char* name : {"official", "far", "close"}) {
            const std::vector<View> views = views_of(fractal, 272, 272);
            const Scene& scene = std::ranges::find(views, name, &View::name)->scene;
            const Count part = sample(scene);
            const Count all = count_operations(scene, {.most_pixels = scene.width * scene.height});
            EXPECT_EQ(all.errors->per_iteration, 0) << "every pixel";
            EXPECT_LT(part.pixels, all.pixels / 3);
            const std::string where = fmt::format("{} {}, ", fractal, name);
            figures.push_back({where + "operations an iteration", part.per_iteration(), part.errors->per_iteration,
                               all.per_iteration()});
            figures.push_back(
                {where + "iterations a call", per_estimate(part), part.errors->per_estimate, per_estimate(all)});
            for (std::size_t i = 0; i < all.lane_use.size(); ++i) {
                const LaneUse& use = part.lane_use[i];
                const LaneUse& truth = all.lane_use[i];
                const std::string lanes = fmt::format("{}{} lanes", where, use.lanes);
                figures.push_back({lanes, use.together.in_iterations, use.together_error->in_iterations,
                                   truth.together.in_iterations});
                figures.push_back({lanes + " refilled", use.refilled->in_iterations, use.refilled_error->in_iterations,
                                   truth.refilled->in_iterations});
            }
        }
    }
    return figures;
}

TEST(Counting, SamplesStandForAllPixelsWithinTheirErrors)
{
    constexpr double most = 4;  // standard errors
    for (const Figure& figure :
         sampled_figures([](const Scene& scene) { return count_operations(scene, {.most_pixels = 18000}); })) {
        SCOPED_TRACE(fmt::format("{}: {:.4f} +- {:.4f}, {:.4f} of all pixels", figure.what, figure.sampled,
                                 figure.error, figure.truth));
        EXPECT_LT(figure.off(), most);
        EXPECT_LT(figure.relative_error(), figure.what.find("lanes") == std::string::npos ? 0.1 : 0.3);
    }
}

// Negative control: if all patches of a sample are in one quarter of the picture, the errors of several quantities
// exceed four standard errors.
TEST(Counting, ABiasedSampleIsOffByMoreThanItsErrors)
{
    int off = 0;
    const auto figures = sampled_figures([](const Scene& scene) {
        std::vector<Block> corner = all_blocks(scene.width, scene.height);
        std::erase_if(
            corner, [&](const Block& block) { return block.column > scene.width / 2 || block.row > scene.height / 2; });
        return count_operations(scene, {}, corner, false);
    });
    for (const Figure& figure : figures) off += figure.off() > 4 ? 1 : 0;
    EXPECT_GT(off, 5) << "of " << figures.size();
}

// The picture's size is not a multiple of the patches' size. Therefore the edges cut patches. The mean position of the
// sampled pixels must be the middle of the picture. A sample on a lattice that begins in a corner fails this.
TEST(Sample, IsSpreadOverTheWholePicture)
{
    constexpr int width = 100;
    constexpr int height = 60;
    EXPECT_EQ(all_blocks(width, height).size(), 28U);
    std::size_t pixels = 0;
    for (const Block& block : all_blocks(width, height)) each_pixel(block, width, height, [&](int, int) { ++pixels; });
    EXPECT_EQ(pixels, 6000U);
    double column = 0;
    double row = 0;
    const std::vector<Block> sample = sample_of_pixels(width, height, 600);
    ASSERT_EQ(sample.size(), 600U);
    for (const Block& pixel : sample) {
        EXPECT_EQ(pixel.side, 1);
        ASSERT_LT(pixel.column, width);
        ASSERT_LT(pixel.row, height);
        column += pixel.column / 600.0;
        row += pixel.row / 600.0;
    }
    EXPECT_NEAR(column, 49.5, 1);
    EXPECT_NEAR(row, 29.5, 1);
    EXPECT_EQ(sample_of_blocks(width, height, 2560).size(), 10U);
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
    const LaneUse use = LaneCount::use({{count}}, true);
    EXPECT_EQ(use.lanes, 2);
    EXPECT_DOUBLE_EQ(use.together.in_steps, 6.0 / 10);
    EXPECT_DOUBLE_EQ(use.together.in_iterations, 25.0 / (2 * 21));
    EXPECT_DOUBLE_EQ(use.refilled->in_steps, 6.0 / 6);
    EXPECT_DOUBLE_EQ(use.refilled->in_iterations, 25.0 / (2 * 19));
    const LaneUse twice = LaneCount::use({{count, count}}, false);
    EXPECT_DOUBLE_EQ(twice.refilled->in_iterations, use.refilled->in_iterations);
    EXPECT_EQ(twice.refilled_error->in_iterations, 0) << "blocks that are alike";
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
