// SPDX-License-Identifier: Apache-2.0
// All timed scenes must give nearly the same picture with any method of stepping along rays. If a picture is noise, its
// speed means nothing.
#include "bench/measure/views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/render/agreement.h"
#include "tests/scenes.h"

namespace mandelmarch::bench {
namespace {

// Side of the pictures in pixels. Smaller pictures give no meaningful fraction of pixels. The reference already takes
// seconds for a close-up of this size.
constexpr int side = 90;

Image canonical_picture(const Scene& scene) { return render(*make_reference_backend(), scene, {.mode = Mode::fast}); }

double percent_off(const Image& canonical, const Scene& scene, Precision precision)
{
    const Image image = render(*make_openmp_backend(), scene, {.precision = precision, .mode = Mode::fast});
    const Comparison c = compare(canonical, image);
    return 100.0 * static_cast<double>(c.visibly_differing) / static_cast<double>(c.pixels);
}

class Views : public testing::TestWithParam<std::string> {};

TEST_P(Views, FastModeHasTheCanonicalPicture)
{
    for (const View& view : views_of(GetParam(), side, side)) {
        const Image canonical = canonical_picture(view.scene);
        for (const Precision precision : {Precision::f64, Precision::f32}) {
            EXPECT_LE(percent_off(canonical, view.scene, precision), most_visible_percent)
                << view.name << ", " << name_of(precision);
        }
    }
}

TEST_P(Views, CloseUpIsAllSurface)
{
    const std::vector<View> views = views_of(GetParam(), side, side);
    const auto close = std::ranges::find(views, "close", &View::name);
    ASSERT_NE(close, views.end());
    const Image image = render(*make_openmp_backend(), close->scene, {.mode = Mode::fast});
    std::size_t hits = 0;
    for (const PixelValue& value : image.values()) hits += std::isfinite(value.depth) ? 1U : 0U;
    EXPECT_GE(hits, image.pixels() * 99 / 100);
}

INSTANTIATE_TEST_SUITE_P(Official, Views, testing::Values("bulb", "box"),
                         [](const auto& test) { return std::string(test.param); });

// Negative control: close to a pole of the Mandelbulb the estimate is several times too large, and hits are noise.
TEST(ViewsControl, PictureAtAPoleIsNoise)
{
    Scene scene = official_scene("bulb", side, side);
    scene.eye = {0.1061, -0.1069, -0.8585};
    scene.target = {-0.6317, 0.5252, -0.6216};
    scene.up = {0.5395, 0.7630, -0.3560};
    scene.field_of_view = 1;
    EXPECT_GT(percent_off(canonical_picture(scene), scene, Precision::f64), most_visible_percent);
}

}  // namespace
}  // namespace mandelmarch::bench
