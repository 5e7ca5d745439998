// SPDX-License-Identifier: Apache-2.0
// `bench random` renders the same random scenes as the tests, and detects pictures beyond fast mode's limits.
#include "bench/fidelity/random_scenes.h"

#include <gtest/gtest.h>

#include <memory>
#include <regex>
#include <vector>

#include "backends/all.h"
#include "bench/measure/views.h"
#include "core/image/compare.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "tests/bench/broken_backend.h"
#include "tests/scenes.h"

namespace mandelmarch::bench {
namespace {

Registry registry()
{
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(make_openmp_backend());
    backends.push_back(std::make_unique<BrokenBackend>(Defect::exact_when_fast, "plain"));
    backends.push_back(without_backend("vulkan", "not built"));
    return Registry(std::move(backends));
}

void no_progress(double) {}

TEST(Random, ScenesAreThoseOfTests)
{
    const RandomResult result =
        measure_random(registry(), {.fractals = default_fractals(), .scenes = 3, .sets = {1001, 77}}, no_progress);
    ASSERT_EQ(result.rows.size(), 2U * 2 * 2 * 3);
    for (const RandomRow& row : result.rows) {
        // The list contains three scenes of each fractal; the second fractal's follow those of the first.
        const bool box = row.fractal == "box";
        const auto index = static_cast<std::size_t>(row.number + (box ? 3 : 0));
        const Scene scene = random_scenes(3, row.set).at(index).scene;
        ASSERT_EQ(row.fractal, scene.fractal->short_name);
        EXPECT_EQ(row.scene.eye.x, scene.eye.x);
        EXPECT_EQ(row.scene.shape, scene.shape);
        const auto drawn = [&](const char* backend) {
            return render(*registry().find(backend), scene, {.precision = row.precision, .mode = Mode::fast});
        };
        const Image canonical = render(*registry().find("reference"), scene, {.mode = Mode::fast});
        EXPECT_EQ(row.off, compare(canonical, drawn("openmp")).visibly_differing);
    }
    for (const RandomSums& sums : result.sums) {
        EXPECT_EQ(sums.all.scenes, 6);
        EXPECT_EQ(sums.sets.at("77").scenes, 3);
        EXPECT_EQ(sums.all.pixels, 6U * 61 * 45);
    }
    EXPECT_EQ(result.sums.size(), 4U);
}

// The constants of relaxed(), fast.step_factor, tails and trials were tuned on scenes of other seeds. Double is precise
// enough for all scenes. Therefore, in double, at most one scene in forty may be far off.
TEST(Random, SetsAreHeldToTheirLimits)
{
    RandomOptions options{.fractals = default_fractals(), .scenes = 40, .sets = {7007}};
    const RandomResult held = measure_random(registry(), options, no_progress);
    EXPECT_TRUE(held.passed()) << to_console(held);
    for (const RandomSums& sums : held.sums) EXPECT_LE(sums.all.far_off, sums.precision == Precision::f64 ? 1 : 40);
    options.scenes = 12;
    options.sets = {1001};
    RandomOptions plain = options;
    plain.backend = "plain";
    const RandomResult missed = measure_random(registry(), plain, no_progress);
    EXPECT_FALSE(missed.passed());  // negative control
    const std::regex lines(
        "\nbulb double, set 1001: [0-9.]+ % off .limit 2 %., [0-9.]+ % hit or miss wrong .limit 0.02 %.; "
        "worst: bin/render --fractal bulb .* - <<< [$]'.*'\nbulb double: .* hold");
    EXPECT_TRUE(std::regex_search(to_console(missed), lines)) << to_console(missed);
}

TEST(Random, MissingBackendIsAnError)
{
    EXPECT_THROW(measure_random(registry(), {.backend = "nosuch"}, no_progress), InputError);
    EXPECT_THROW(measure_random(registry(), {.backend = "vulkan"}, no_progress), Unavailable);
}

}  // namespace
}  // namespace mandelmarch::bench
