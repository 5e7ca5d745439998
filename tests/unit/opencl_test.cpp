// SPDX-License-Identifier: Apache-2.0
// OpenCL's vectors give the bits of the scalar kernel and count the same work, in blocks of pixels, in lanes with
// refill, and at the edges of strips. The tests are skipped if there is no OpenCL device.
#include <gtest/gtest.h>

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
    // The Mandelbox is rendered with refill. The sizes of the pictures are not multiples of a block, a strip or a work
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

// Negative control: with another detail level, hits are elsewhere.
TEST_P(Opencl, AnotherSceneHasOtherBits)
{
    Scene other = official_scene("box", 301, 37);
    other.detail -= 0.01;
    const Image official = render(opencl, official_scene("box", 301, 37), {.precision = GetParam()});
    EXPECT_FALSE(compare(official, render(opencl, other, {.precision = GetParam()})).same());
}

INSTANTIATE_TEST_SUITE_P(Precisions, Opencl, testing::Values(Precision::f64, Precision::f32),
                         [](const auto& test) { return std::string(name_of(test.param)); });

}  // namespace
}  // namespace mandelmarch
