// SPDX-License-Identifier: Apache-2.0
// For every backend, the parts of Timings are as defined in core/render/backend.h: they do not overlap, and their sum
// is not more than the wall time.
#include <gtest/gtest.h>

#include "backends/all.h"
#include "core/render/registry.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

constexpr double rounding = 1e-6;  // seconds; largest rounding error of the sum of a picture's parts

TEST(Timings, PartsAreApartAndWithinTheWallTime)
{
    const Registry registry = all_backends();
    int pictures = 0;
    for (const auto& backend : registry.backends()) {
        const Listing found = listing_of(*backend);
        for (int device = 0; device < static_cast<int>(found.devices.size()); ++device) {
            for (const Mode mode : {Mode::exact, Mode::fast}) {
                for (const char* short_name : {"bulb", "box"}) {
                    const Scene scene = official_scene(short_name, 64, 48);
                    const Precision precision = backend->name() == "reference" ? Precision::f64 : Precision::f32;
                    const auto renderer =
                        backend->create({.device = device, .precision = precision, .mode = mode, .counts = false});
                    for (const auto layers : {Image::Layers::all, Image::Layers::bytes, Image::Layers::bytes}) {
                        Image image(scene.width, scene.height, layers);
                        const Timings t = renderer->render(scene, image).timings;
                        SCOPED_TRACE(std::string(backend->name()) + " " + std::to_string(device) + " " + short_name);
                        for (const double part : {t.context, t.build, t.upload, t.readback}) EXPECT_GE(part, 0);
                        EXPECT_GT(t.kernel, 0);
                        EXPECT_LE(t.kernel, t.host + rounding);
                        EXPECT_LE(t.build + t.upload + t.host + t.readback, t.wall + rounding);
                        const bool on_host = backend->name() == "reference" || backend->name() == "openmp";
                        if (!on_host) {
                            EXPECT_GT(t.readback, 0);
                            EXPECT_GT(t.upload, 0);
                        }
                    }
                    ++pictures;
                }
            }
        }
    }
    EXPECT_GE(pictures, 8) << "reference and openmp at least";
}

}  // namespace
}  // namespace mandelmarch
