// SPDX-License-Identifier: Apache-2.0
// The Vulkan backend gives the bits of the scalar kernel in pictures of many passes or bands, and counts the same work.
// In each test one renderer renders all scenes, one after the other. The tests are skipped if there is no Vulkan
// device.
#include <gtest/gtest.h>

#include "backends/all.h"
#include "tests/scenes.h"
#include "tests/unit/same_picture.h"

namespace mandelmarch {
namespace {

// Returns a scene whose eye is inside the solid. Every DE evaluation takes all iterations. Therefore even a pass of one
// step has more loop iterations than lavapipe allows.
Scene long_estimates()
{
    Scene scene = official_scene("bulb", 24, 18);
    scene.eye = {0.001, 0.002, 0.001};
    scene.shape[1] = 1e6;
    scene.shape[2] = 1;
    scene.iterations = 10'000;
    scene.escape = 0;
    return scene;
}

class Vulkan : public testing::TestWithParam<Precision> {
protected:
    void SetUp() override
    {
        if (const auto why = vulkan.unavailable()) GTEST_SKIP() << *why;
        scenes.push_back({"one pixel", official_scene("bulb", 1, 1)});
        scenes.push_back({"five bands", official_scene("bulb", 400, 390)});
        scenes.push_back({"one row of many bands", official_scene("box", 20000, 2)});
        scenes.push_back({"ten thousand iterations", long_estimates()});
    }

    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");
    const Backend& vulkan = *registry.find("vulkan");
    std::vector<NamedScene> scenes;
};

TEST_P(Vulkan, DrawsTheBitsOfTheScalarText)
{
    const auto renderer = vulkan.create({.precision = GetParam()});
    const auto baseline = openmp.create({.precision = GetParam(), .simd_width = 1});
    for (const auto& [name, scene] : scenes) expect_same_picture(*baseline, *renderer, scene, name);
}

TEST_P(Vulkan, TimesArePartsOfTheWallTime)
{
    const Scene scene = official_scene("bulb", 64, 64);
    const auto renderer = vulkan.create({.precision = GetParam()});
    Image image(64, 64, Image::Layers::bytes);
    const Timings first = renderer->render(scene, image).timings;
    EXPECT_GT(first.context, 0);
    EXPECT_GT(first.build, 0);
    EXPECT_GT(first.upload, 0);
    EXPECT_GT(first.kernel, 0);
    EXPECT_GE(first.host, first.kernel);
    EXPECT_GT(first.readback, 0);
    EXPECT_GE(first.wall, first.build + first.upload + first.host + first.readback);
    const Timings second = renderer->render(scene, image).timings;
    EXPECT_EQ(second.build, 0);
}

INSTANTIATE_TEST_SUITE_P(Precisions, Vulkan, testing::Values(Precision::f64, Precision::f32),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace mandelmarch
