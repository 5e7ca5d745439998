// SPDX-License-Identifier: Apache-2.0
// Cameras that the original program does not have: panoramas of all directions, and two eyes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/render/stereo.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

Scene all_directions(int width, int height)
{
    Scene scene = official_scene("bulb", width, height);
    scene.projection = Projection::equirectangular;
    return scene;
}

// Rays in the middle column of the picture go towards the target. Rays in the column that is a quarter of the width
// further right go to the camera's right.
TEST(AllDirections, TurnWithTheColumns)
{
    Scene scene = all_directions(64, 32);
    scene.eye = {0, 0, 3};
    scene.target = {0, 0, 0};
    const auto depth = [](const Image& image, int x, int y) {
        return image.values()[static_cast<std::size_t>(y * image.width() + x)].depth;
    };
    const Image ahead = render(*make_openmp_backend(), scene, {});
    EXPECT_NEAR(depth(ahead, 32, 16), 2.3, 0.3);
    EXPECT_TRUE(std::isinf(depth(ahead, 0, 16)));
    scene.target = {-1, 0, 3};  // now the fractal is on the right
    const Image aside = render(*make_openmp_backend(), scene, {});
    EXPECT_EQ(depth(aside, 48, 16), depth(ahead, 32, 16));
    EXPECT_TRUE(std::isinf(depth(aside, 32, 16)));
}

// Some techniques of fast mode use the distance between pixels, which differs between the usual camera and this one.
// The picture must be the canonical one with this camera, too.
TEST(AllDirections, FastDrawsTheCanonicalPicture)
{
    for (const char* fractal : {"bulb", "box"}) {
        Scene scene = official_scene(fractal, 240, 120);
        scene.projection = Projection::equirectangular;
        const RendererOptions fast{.mode = Mode::fast};
        RendererOptions plain = fast;
        plain.techniques = techniques_without("hull,relaxation,cones,neighbours");
        const Comparison difference =
            compare(render(*make_openmp_backend(), scene, plain), render(*make_openmp_backend(), scene, fast));
        EXPECT_LE(difference.visibly_differing, difference.pixels / 100) << fractal;
    }
}

class TwoEyes : public testing::Test {
protected:
    TwoEyes()
    {
        scene.eye = {0, 0, 3};
        scene.target = {0, 0, 0};
    }

    Image drawn(double eyes) const
    {
        Image image(scene.width, scene.height, Image::Layers::all);
        render_stereo(*make_openmp_backend()->create({}), scene, eyes, image);
        return image;
    }

    // Returns the mean column of the hits in one half of the picture. `side`: negative for the left half.
    static double middle(const Image& image, int side)
    {
        const int half = image.width() / 2;
        double sum = 0;
        double count = 0;
        for (int y = 0; y < image.height(); ++y) {
            for (int x = 0; x < half; ++x) {
                const auto at = static_cast<std::size_t>(y * image.width() + x + (side > 0 ? half : 0));
                if (std::isinf(image.values()[at].depth)) continue;
                sum += x;
                ++count;
            }
        }
        return sum / count;
    }

    Scene scene = official_scene("bulb", 320, 300);
};

TEST_F(TwoEyes, EachHasTheBitsOfItsOwnPicture)
{
    const Image both = drawn(0.1);
    for (const int side : {-1, 1}) {
        const Image one = render(*make_openmp_backend(), of_eye(scene, 0.1, side), {});
        for (int y = 0; y < one.height(); ++y) {
            const auto row = both.bytes().begin() + 3 * (y * both.width() + (side < 0 ? 0 : one.width()));
            EXPECT_TRUE(std::equal(row, row + 3 * one.width(), one.bytes().begin() + 3 * y * one.width())) << side;
        }
    }
}

// If a point is nearer than the screen, it is further right in the left eye's picture than in the right eye's. If it is
// behind the screen, it is further left.
TEST_F(TwoEyes, ShowNearPointsCrossed)
{
    const double distance = 3;
    const Image near = drawn(4 * distance / screen_distance);
    EXPECT_GT(middle(near, -1), middle(near, 1));
    const Image far = drawn(0.1 * distance / screen_distance);
    EXPECT_LT(middle(far, -1), middle(far, 1));
}

TEST_F(TwoEyes, NeedAnEvenWholePicture)
{
    scene.width = 321;
    EXPECT_THROW(drawn(0.1), InputError);
    scene.width = 320;
    scene.crop_window = {.whole_width = 640, .whole_height = 600};
    EXPECT_THROW(drawn(0.1), InputError);
}

// In a panorama the line between the two eyes turns with the direction of the ray. If it did not turn, objects at the
// camera's sides would have no parallax.
TEST_F(TwoEyes, TurnWithTheDirectionOfAPanorama)
{
    scene.width = 1440;
    scene.height = 360;
    scene.projection = Projection::equirectangular;
    for (const Vector ahead : {Vector{0, 0, -1}, Vector{1, 0, 0}, Vector{-1, 0, 0}, Vector{1, 0, 0.5}}) {
        scene.target = scene.eye + ahead;
        const Image image = drawn(0.4);
        const double parallax = middle(image, -1) - middle(image, 1);  // in columns
        EXPECT_NEAR(parallax, 720 * 0.4 / (2 * std::numbers::pi * 3), 2.5) << ahead.x << ' ' << ahead.z;
    }
}

// If both eyes are at one place, each sees the same panorama. The test uses exact mode, because in fast mode a pixel
// may depend on the strip in which it is rendered.
TEST_F(TwoEyes, AtOnePlaceShowThePanorama)
{
    scene.width = 320;
    scene.height = 80;
    scene.projection = Projection::equirectangular;
    const Image both = drawn(0);
    scene.width = 160;
    const Image one = render(*make_openmp_backend(), scene, {});
    std::size_t differing = 0;
    for (std::size_t i = 0; i < both.bytes().size(); ++i) {
        const std::size_t row = i / (3 * 320);
        const std::size_t column = i % (3 * 160);
        differing += std::abs(both.bytes()[i] - one.bytes()[row * 3 * 160 + column]) > 2 ? 1 : 0;
    }
    EXPECT_LT(differing, both.bytes().size() / 1000);
}

}  // namespace
}  // namespace mandelmarch
