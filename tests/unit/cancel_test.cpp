// SPDX-License-Identifier: Apache-2.0
// Tests cancelling a render.
#include <gtest/gtest.h>

#include <algorithm>

#include "backends/all.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

bool black(const Image& image)
{
    return std::ranges::all_of(image.bytes(), [](std::uint8_t byte) { return byte == 0; });
}

TEST(Cancelling, EveryBackendEndsAndDrawsAgain)
{
    const Registry registry = all_backends();
    const Scene scene = official_scene("bulb", 40, 30);
    for (const auto& backend : registry.backends()) {
        if (backend->unavailable()) continue;
        SCOPED_TRACE(backend->name());
        const auto renderer = backend->create({});
        Image image(40, 30, Image::Layers::bytes);
        std::stop_source source;
        source.request_stop();
        EXPECT_THROW(renderer->render(scene, image, Progress(source.get_token())), Cancelled);
        EXPECT_NO_THROW(renderer->render(scene, image, Progress(std::stop_source().get_token())));
        EXPECT_FALSE(black(image));
    }
}

// The picture is a single band. Therefore this tests cancelling between tiles, not between bands.
TEST(Cancelling, OpenmpDrawsNoMoreTiles)
{
    const Registry registry = all_backends();
    const auto renderer = registry.find("openmp")->create({});
    Image image(40, 30, Image::Layers::bytes);
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(renderer->render(official_scene("bulb", 40, 30), image, Progress(source.get_token())), Cancelled);
    EXPECT_TRUE(black(image));
}

}  // namespace
}  // namespace mandelmarch
