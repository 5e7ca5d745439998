// SPDX-License-Identifier: Apache-2.0
// The profiler's picture must equal openmp's. If openmp's picture differs, the study fails with one line.
#include "bench/harness/profile.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <tuple>

#include "backends/all.h"
#include "backends/openmp/profile.h"
#include "backends/openmp/variants.h"
#include "core/base/error.h"
#include "tests/bench/broken_backend.h"
#include "tests/scenes.h"

namespace mandelmarch::bench {
namespace {

bool has_packs() { return openmp::variants_of<float>("mandelbox", Mode::fast).back().pack > 1; }

// Returns scenes that include every look, an eye inside the solid, and sizes that are not multiples of a tile.
std::vector<NamedScene> scenes()
{
    std::vector<NamedScene> all = odd_scenes();
    for (const char* name : {"bulb", "box", "julia"}) {
        for (const int colouring : {0, 1, 2, 3, 4}) {
            Scene scene = official_scene(name, 133, 77);
            scene.colouring = colouring;
            all.push_back({fmt::format("{}, colouring {}", name, colouring), scene});
        }
    }
    return all;
}

Image by_stages(const Scene& scene, Precision precision, Mode mode)
{
    Image image(scene.width, scene.height, Image::Layers::bytes);
    openmp::make_profiler(scene, precision, mode)->draw(image);
    return image;
}

class ProfiledPicture : public testing::TestWithParam<std::tuple<Precision, Mode>> {};

// For this comparison openmp renders without shared occlusion, because the profiler computes the occlusion of every
// pixel.
TEST_P(ProfiledPicture, IsTheBackendsOwn)
{
    const auto [precision, mode] = GetParam();
    const Registry registry = all_backends();
    const auto renderer = registry.find("openmp")->create({.precision = precision,
                                                           .mode = mode,
                                                           .counts = false,
                                                           .techniques = {.trial = false, .shared_occlusion = false}});
    if (!has_packs()) GTEST_SKIP() << "no vectors";
    for (const auto& [name, scene] : scenes()) {
        Image own(scene.width, scene.height, Image::Layers::bytes);
        renderer->render(scene, own);
        EXPECT_EQ(by_stages(scene, precision, mode).bytes(), own.bytes()) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(All, ProfiledPicture,
                         testing::Combine(testing::Values(Precision::f32, Precision::f64),
                                          testing::Values(Mode::exact, Mode::fast)));

// Returns the error message of the study `profile` if openmp has this defect; empty if there is no error.
std::string complaint(Defect defect)
{
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(std::make_unique<BrokenBackend>(defect, "openmp"));
    const Registry registry(std::move(backends));
    Options options;
    options.fractals = {&fractal_named("box")};
    options.modes = {Mode::fast};
    options.precisions = {Precision::f32};
    options.size = {48, 40};
    options.study = &study_named("profile");
    options.repetitions = 1;
    try {
        profile(registry, options, [](const Step&) {});
    } catch (const Error& error) {
        return error.what();
    }
    return {};
}

TEST(Profile, RefusesAPictureThatIsNotTheBackendsOwn)
{
    if (!has_packs()) GTEST_SKIP() << "no vectors";
    EXPECT_EQ(complaint(Defect::none), "");
    EXPECT_EQ(complaint(Defect::one_byte),
              "study profile: mandelbox, float, fast: the picture is wrong: 1 of 1920 pixels differ from openmp's own");
}

}  // namespace
}  // namespace mandelmarch::bench
