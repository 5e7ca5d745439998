// SPDX-License-Identifier: Apache-2.0
// OpenCL's vectors give the bits of the scalar kernel and count the same work, in blocks of pixels, in lanes with
// refill, and at the edges of strips. The tests are skipped if there is no OpenCL device.
#include <gtest/gtest.h>

#include <vector>

#include "backends/all.h"
#include "core/image/compare.h"
#include "tests/scenes.h"
#include "tests/unit/same_picture.h"

namespace mandelmarch {
namespace {

class Opencl : public testing::TestWithParam<Precision> {
protected:
    void SetUp() override
    {
        if (const auto why = opencl.unavailable()) GTEST_SKIP() << *why;
    }

    const Registry registry = all_backends();
    const Backend& openmp = *registry.find("openmp");
    const Backend& opencl = *registry.find("opencl");
    // Lanes are refilled. The sizes of the pictures are not multiples of a block, a strip or a work
    // group.
    const std::vector<NamedScene> scenes{{"bulb", official_scene("bulb", 301, 37)},
                                         {"box", official_scene("box", 301, 37)},
                                         {"a row of the box", official_scene("box", 1030, 1)},
                                         {"one pixel of the box", official_scene("box", 1, 1)}};
};

TEST_P(Opencl, VectorsDrawTheBitsOfTheScalarText)
{
    const auto baseline = openmp.create({.precision = GetParam(), .simd_width = 1});
    for (const int simd_width : {0, 1, 4}) {  // 0: the longest vector that suits the device
        const auto renderer = opencl.create({.precision = GetParam(), .simd_width = simd_width});
        for (const auto& [name, scene] : scenes) {
            expect_same_picture(*baseline, *renderer, scene, name + ", SIMD width " + std::to_string(simd_width));
        }
    }
}

// In fast mode vectors begin rays at cones and neighbours. Fast pictures are those of the scalar kernel, up to 1 % of
// the pixels and of the steps.
TEST_P(Opencl, FastVectorsDrawThePictureOfTheScalarKernel)
{
    const auto drawn = [&](const Backend& backend, int simd_width, const Scene& scene) {
        Image image(scene.width, scene.height, Image::Layers::all);
        const RendererOptions options{.precision = GetParam(), .mode = Mode::fast, .simd_width = simd_width};
        const double steps = static_cast<double>(backend.create(options)->render(scene, image).work.steps);
        return std::pair(std::move(image), steps);
    };
    for (const auto& [width, height] : {std::pair(301, 293), {17, 1}, {1, 5}}) {
        Scene scene = official_scene("bulb", width, height);
        scene.detail = -2;  // a coarse tolerance, so that small pictures have neighbours
        const auto [expected, steps] = drawn(openmp, 1, scene);
        for (const int simd_width : GetParam() == Precision::f64 ? std::vector{2, 8} : std::vector{4, 32}) {
            const auto [image, taken] = drawn(opencl, simd_width, scene);
            EXPECT_LE(100 * compare(expected, image).visibly_differing, expected.pixels()) << simd_width;
            EXPECT_NEAR(taken, steps, 0.01 * steps) << simd_width;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Precisions, Opencl, testing::Values(Precision::f64, Precision::f32),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace mandelmarch
