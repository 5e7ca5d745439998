// SPDX-License-Identifier: Apache-2.0
// Compares the pictures and work counts of two renderers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/image/compare.h"
#include "core/render/backend.h"

namespace mandelmarch {

// Expects that both renderers give the same bits and the same work counts. `what`: name of the picture in messages.
inline void expect_same_picture(Renderer& baseline, Renderer& renderer, const Scene& scene, const std::string& what)
{
    Image image(scene.width, scene.height, Image::Layers::all);
    Image expected(scene.width, scene.height, Image::Layers::all);
    const Work work = renderer.render(scene, image).work;
    const Work expected_work = baseline.render(scene, expected).work;
    const Comparison difference = compare(expected, image);
    EXPECT_TRUE(difference.same()) << what << ": "
                                   << describe_pixel(expected, image, std::max<std::int64_t>(0, difference.first));
    EXPECT_EQ(work.steps, expected_work.steps) << what;
    EXPECT_EQ(work.de_calls, expected_work.de_calls) << what;
    EXPECT_EQ(work.iterations, expected_work.iterations) << what;
}

}  // namespace mandelmarch
