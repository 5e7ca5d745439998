// SPDX-License-Identifier: Apache-2.0
// Expectations that pictures are the same, or that work counts are the same.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/image/compare.h"
#include "core/render/backend.h"

namespace mandelmarch {

// Expects that both pictures have the same bits. `what`: name of the picture in messages.
inline void expect_same_bits(const Image& expected, const Image& image, const std::string& what)
{
    const Comparison difference = compare(expected, image);
    EXPECT_TRUE(difference.same()) << what << ": "
                                   << describe_pixel(expected, image, std::max<std::int64_t>(0, difference.first));
}

inline void expect_same_work(const Work& expected, const Work& work, const std::string& what)
{
    EXPECT_EQ(work.steps, expected.steps) << what;
    EXPECT_EQ(work.de_calls, expected.de_calls) << what;
    EXPECT_EQ(work.iterations, expected.iterations) << what;
}

// Expects that both renderers give the same bits and the same work counts.
inline void expect_same_picture(Renderer& baseline, Renderer& renderer, const Scene& scene, const std::string& what)
{
    Image image(scene.width, scene.height, Image::Layers::all);
    Image expected(scene.width, scene.height, Image::Layers::all);
    const Work work = renderer.render(scene, image).work;
    const Work expected_work = baseline.render(scene, expected).work;
    expect_same_bits(expected, image, what);
    expect_same_work(expected_work, work, what);
}

}  // namespace mandelmarch
