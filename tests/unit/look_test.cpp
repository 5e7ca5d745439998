// SPDX-License-Identifier: Apache-2.0
// Looks: their files, and the effect of their numbers.
#include "core/scene/look.h"

#include <gtest/gtest.h>

#include <string>

#include "backends/all.h"
#include "core/image/compare.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "tests/refusal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

std::string error_of(const std::string& text)
{
    return refusal_of([&] { parse_look(text, "a.look"); });
}

Image picture_of(const Backend& openmp, Scene scene, const LookValues& look)
{
    scene.look = look;
    Image image(scene.width, scene.height, Image::Layers::bytes);
    openmp.create({.precision = Precision::f64, .mode = Mode::exact})->render(scene, image);
    return image;
}

TEST(Look, EveryNumberOfTheKernelChangesThePicture)
{
    const auto openmp = make_openmp_backend();
    Scene scene = official_scene("box", 64, 32);
    scene.projection = Projection::equirectangular;
    scene.colouring = 2;
    const LookValues look = cloudy_look();
    const auto before = picture_of(*openmp, scene, look);
    EXPECT_TRUE(compare(picture_of(*openmp, scene, look), before).same());
    for (std::size_t i = 0; i < std::size(KernelScene<double>{}.look); ++i) {
        LookValues changed = look;
        changed.numbers.at(i) += 0.3;
        EXPECT_FALSE(compare(picture_of(*openmp, scene, changed), before).same()) << "number " << i;
    }
}

// A Mandelbox is the same after a permutation of its axes, so its picture stays the same if the sky is permuted, too.
TEST(Look, LightTurnsWithTheSky)
{
    const auto openmp = make_openmp_backend();
    const auto permuted = [](Vector v) { return Vector{v.z, v.x, v.y}; };
    const Scene scene = official_scene("box", 64, 32);
    const Image expected = picture_of(*openmp, scene, cloudy_look());
    Scene turned = scene;
    for (Vector Scene::*member : {&Scene::eye, &Scene::target, &Scene::up}) turned.*member = permuted(scene.*member);
    EXPECT_GT(compare(picture_of(*openmp, turned, cloudy_look()), expected).visibly_differing, 1000);
    turned.sky = {permuted(scene.sky.up), permuted(scene.sky.north), permuted(scene.sky.sun)};
    EXPECT_LT(compare(picture_of(*openmp, turned, cloudy_look()), expected).visibly_differing, 200);
}

TEST(Look, GrainChangesManyBytesOfASkyByOne)
{
    const auto openmp = make_openmp_backend();
    Scene scene = official_scene("box", 256, 16);
    scene.target = 2.0 * scene.eye;
    const Image plain = picture_of(*openmp, scene, *look_named("lagoon"));
    scene.grainy = true;
    const Comparison change = compare(picture_of(*openmp, scene, *look_named("lagoon")), plain);
    EXPECT_EQ(change.largest, 1);
    EXPECT_GT(change.differing, change.pixels / 4);
}

TEST(Look, FileGivesItsNumbers)
{
    const LookValues look =
        parse_look("# mine\nexposure 2 # bright\n\r\n\tsurface 0.1 0.2 0.3\r\nsun_azimuth 110", "a.look");
    EXPECT_EQ(look.numbers[0], 0.1);
    EXPECT_EQ(look.numbers[2], 0.3);
    EXPECT_EQ(look.numbers[67], 2);
    EXPECT_EQ(look.sun_azimuth(), 110);
    EXPECT_EQ(look.sun_height(), 0);
}

TEST(Look, WrongLinesAreNamed)
{
    EXPECT_EQ(error_of(""), "a.look: the entry exposure is missing, expected a look file");
    EXPECT_EQ(error_of("exposure 1\ngloss 2\n"),
              "a.look:2: 'gloss' given, expected an entry of a look, such as exposure");
    EXPECT_EQ(error_of("exposure 1\nexposure 1\n"), "a.look:2: exposure is given twice");
    EXPECT_EQ(error_of("exposure\n"), "a.look:1: exposure has 0 numbers, expected 1");
    EXPECT_EQ(error_of("surface 1 2\n"), "a.look:1: surface has 2 numbers, expected 3");
    EXPECT_EQ(error_of("surface 0 0 2\n"), "a.look:1: surface has '2', expected a number from 0 to 1");
    EXPECT_EQ(error_of("layer_1 0 0 -1 0 0 0 0 1\n"), "a.look:1: layer_1 has '-1', expected a number from 0 to 1");
    EXPECT_EQ(error_of("exposure 1\nlayer_1 0 0 1 -9 0 0 -2 1\n"), "");
    EXPECT_EQ(error_of("haze nan\n"), "a.look:1: haze has 'nan', expected a number from 0 to 1");
    EXPECT_EQ(error_of("exposure 1\n"), "");
}

// Each built-in look has its own numbers, and the look of a scene replaces them.
TEST(Look, BelongsToTheColouringType)
{
    EXPECT_NE(*look_named("limestone"), *look_named("coral"));
    EXPECT_EQ(look_named("normals as RGB"), nullptr);
    Scene scene = official_scene("bulb", 16, 9);
    scene.colouring = 4;
    EXPECT_EQ(look_of(scene), look_named("lagoon"));
    scene.look = cloudy_look();
    EXPECT_EQ(*look_of(scene), cloudy_look());
}

}  // namespace
}  // namespace mandelmarch
