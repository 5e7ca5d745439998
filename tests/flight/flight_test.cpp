// SPDX-License-Identifier: Apache-2.0
// Planning, path files and audits. Results are the same on any number of threads, and every item of an audit can fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "flight/audit/audit.h"
#include "flight/audit/motion.h"
#include "flight/audit/views.h"
#include "flight/film/shrink.h"
#include "flight/plan/planner.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

constexpr int frames = 400;

const Path& planned()
{
    static const Path path = plan(official_scene("bulb", 16, 9), {}, 3, frames, 0).path;
    return path;
}

const Row& row_of(const Audit& audit, const std::string& name)
{
    const auto row = std::ranges::find_if(audit.rows, [&](const Row& r) { return r.name.starts_with(name); });
    if (row == audit.rows.end()) throw Error("no row " + name);
    return *row;
}

// Returns the audit of the planned path after `spoil` has changed its frames.
template <class Spoil>
Audit spoilt(Spoil spoil)
{
    Path path = planned();
    spoil(path.frames);
    return audit(path, 0, 0, 5);
}

void move_to(Frame& frame, Vector place)
{
    frame.target = place + (frame.target - frame.eye);
    frame.eye = place;
}

TEST(DistanceField, SymmetricPlacesAreOne)
{
    const Scene bulb = official_scene("bulb", 16, 9);
    const DistanceField field(bulb, 1);
    const Vector p{0.7, 0.2, 0.8};
    const double turn = 2 * std::acos(-1.0) / 7;
    const Vector q{p.x * std::cos(turn) - p.y * std::sin(turn), -(p.x * std::sin(turn) + p.y * std::cos(turn)), p.z};
    EXPECT_NEAR(field.distance(p), field.distance(q), 1e-9);
    EXPECT_LT(length(field.representative(p) - field.representative(q)), 1e-9);
    const DistanceField box(official_scene("box", 16, 9), 1);
    EXPECT_LT(length(box.representative({1, -2, 3}) - box.representative({-3, 1, 2})), 1e-12);
}

TEST(Plan, TheSameSeedGivesTheSamePathOnAnyNumberOfThreads)
{
    const Scene scene = official_scene("box", 16, 9);
    const std::string one = to_text(plan(scene, {}, 9, 150, 1).path);
    EXPECT_EQ(one, to_text(plan(scene, {}, 9, 150, 3).path));
    EXPECT_NE(one, to_text(plan(scene, {}, 10, 150, 3).path));
}

TEST(Plan, KeepsEveryPromise)
{
    const Audit result = audit(planned(), 1);
    EXPECT_TRUE(result.promises_kept()) << table_of(planned(), result);
    // The audit is the same on any number of threads.
    EXPECT_EQ(json_of(planned(), result), json_of(planned(), audit(planned(), 4)));
}

// A flight planned with the conservative estimate, which films use, keeps every promise. It differs from the flight
// planned with the original estimate.
TEST(Plan, KeepsEveryPromiseByTheConservativeEstimate)
{
    Scene scene = official_scene("bulb", 16, 9);
    scene.conservative = true;
    const Path path = plan(scene, {}, 3, frames, 0).path;
    const Audit result = audit(path, 0, 0, 5);
    EXPECT_TRUE(result.promises_kept()) << table_of(path, result);
    EXPECT_NE(to_text(path), to_text(planned()));
}

TEST(Audit, EveryRowCanFail)
{
    const Audit sound = audit(planned(), 0, 0, 5);
    const auto fails = [&](const Audit& result, const std::string& name) {
        EXPECT_TRUE(row_of(sound, name).kept()) << name << " fails unspoilt";
        EXPECT_FALSE(row_of(result, name).kept()) << name;
        return result.promises_kept();
    };
    // Items of the audit that are promises.
    EXPECT_FALSE(fails(spoilt([](auto& f) { move_to(f[200], {0, 0, 0.1}); }), "frames inside solid"));
    // Both frames are outside the solid, but the straight line between them is not.
    EXPECT_FALSE(fails(spoilt([](auto& f) {
                           move_to(f[0], {0, 0, 2});
                           move_to(f[1], {0, 0, -2});
                       }),
                       "frames inside solid"));
    EXPECT_FALSE(fails(spoilt([](auto& f) { f.erase(f.begin() + 300, f.begin() + 330); }), "largest step"));
    EXPECT_FALSE(
        fails(spoilt([](auto& f) { f[250].target = f[250].eye + unit(f[250].target - f[250].eye + 0.05 * f[250].up); }),
              "largest turn"));
    EXPECT_FALSE(
        fails(spoilt([](auto& f) { std::fill(f.begin() + 300, f.begin() + 390, f[300]); }), "longest time standing"));
    // Items of the audit that describe quality.
    const DistanceField field(planned().scene, 0);
    fails(spoilt([&](auto& f) {
              Vector place = f[300].eye;
              while (field.distance(place) > 0.002)
                  place = place - 0.3 * field.distance(place) * field.uphill(place, 1e-4);
              move_to(f[300], place);
          }),
          "least DE");
    // The first 300 frames of this short flight are outside the hull, the others inside. Without the first ones the
    // item is kept; it is not kept if the others are moved outside.
    const std::string in_hull = "frames inside the hull";
    EXPECT_TRUE(row_of(spoilt([](auto& f) { f.erase(f.begin(), f.begin() + 300); }), in_hull).kept());
    EXPECT_FALSE(row_of(spoilt([](auto& f) {
                            f.erase(f.begin(), f.begin() + 300);
                            for (auto& frame : f) move_to(frame, unit(frame.eye) + unit(frame.eye));
                        }),
                        in_hull)
                     .kept());
    const auto all_turned = [](auto& f, auto turn) {
        for (auto& frame : f) frame.target = frame.eye + turn(frame.target - frame.eye);
    };
    fails(spoilt([&](auto& f) { all_turned(f, [](Vector v) { return -1 * v; }); }), "frames looking more than 60");
    fails(spoilt([&](auto& f) {
              for (auto& frame : f) frame.target = frame.eye + unit(frame.eye);
          }),
          "dull frames");
    fails(spoilt([&](auto& f) {
              for (auto& frame : f) frame.target = frame.eye + unit(frame.eye);
          }),
          "longest time of dull");
    fails(spoilt([](auto& f) {
              for (std::size_t i = 0; i < f.size(); i += 10) f[i + 1] = f[i];
          }),
          "frames with apparent motion");
    fails(spoilt([](auto& f) {
              for (std::size_t i = 0; i < f.size(); i += 10) f[i + 1] = f[i];
          }),
          "jerk, 95 of 100");
    fails(spoilt([](auto& f) {
              for (std::size_t i = 0; i < f.size(); i += 10) f[i].target = f[i].target + 0.01 * f[i].up;
          }),
          "angular jerk");
    fails(spoilt([](auto& f) {
              for (auto& frame : f) frame.up = cross(frame.target - frame.eye, frame.up);
          }),
          "frames with a horizon");
    fails(spoilt([](auto& f) {
              for (auto& frame : f) frame.target = frame.eye + unit(frame.eye);
          }),
          "frames under 40 %");
    // Seen from far away, with its direction 30 degrees off the picture's middle, the fractal is in the corner.
    fails(spoilt([](auto& f) {
              for (auto& frame : f) {
                  move_to(frame, {0, 0, 12});
                  frame.target = frame.eye + Vector{0.8, 0.4, -1};
              }
          }),
          "longest time with the subject at the edge");
    fails(spoilt([](auto& f) {
              // First the camera looks at the sky, then the same part of the path is repeated.
              for (std::size_t i = 200; i < 290; ++i) f[i].target = f[i].eye + unit(f[i].eye);
              std::copy(f.begin() + 110, f.begin() + 200, f.begin() + 290);
          }),
          "the same view again");
    // A flight of ten seconds need not have a passage. A film of full length needs some, and has none if the camera
    // stands still.
    Path long_path = planned();
    long_path.frames.assign(7200, planned().frames[0]);
    fails(audit(long_path, 0, 0, 300), "distinct passages");
    fails(spoilt([](auto& f) {
              for (std::size_t i = 0; i + 1 < f.size(); ++i) {
                  const double angle = 1.19 * std::acos(-1.0) / 180 * static_cast<double>(i);
                  f[i].target = f[i].eye + Vector{std::cos(angle), std::sin(angle), 0};
                  f[i].up = {0, 0, 1};
              }
          }),
          "frames at the cap");
    EXPECT_FALSE(row_of(audit(planned(), 0, 1000, 50), "planning").kept());
}

TEST(Audit, PassagesAreCountedModuloTheSymmetry)
{
    const DistanceField field(official_scene("box", 16, 9), 1);
    const auto always = [&](std::size_t) -> const DistanceField& { return field; };
    const std::vector<Vector> places{{1, 2, 3},    {1, 2, 3.1}, {1, 2, 3.2}, {2, 1, -3.3},
                                     {-3.1, 2, 1}, {3, 3, 3},   {3, 3, 2}};
    const std::vector<double> once{1, 0.4, 0.9, 0.9, 0.9, 0.9, 0.9};
    EXPECT_EQ(distinct_passages(always, places, once).size(), 1U);
    const std::vector<double> mirrored{1, 0.04, 1, 1, 0.04, 1, 1};
    EXPECT_EQ(distinct_passages(always, places, mirrored).size(), 1U);
    const std::vector<double> twice{1, 0.04, 1, 1, 1, 0.1, 1};
    EXPECT_EQ(distinct_passages(always, places, twice).size(), 2U);
    const std::vector<double> shallow{1, 0.6, 1, 1, 1, 1, 1};
    EXPECT_TRUE(distinct_passages(always, places, shallow).empty());
}

TEST(PathFile, IsReadAsItIsWritten)
{
    Path path = planned();
    path.frames[3].changes.shape = {0, 4, 7.5};
    path.frames[4].changes.brightness = 1.5;
    path.frames[4].changes.iterations = 50;
    path.frames[5].changes.detail = -3.5;
    const std::string text = to_text(path);
    EXPECT_EQ(to_text(path_from_text(text, "test")), text);
    const Scene changed = scene_of(path, path.frames[3], 64, 36);
    EXPECT_EQ(changed.shape[2], 7.5);
    // If the fractal changes during the flight, each frame is audited with the shape at that frame.
    EXPECT_NE(json_of(path, audit(path, 0, 0, 50)), json_of(planned(), audit(planned(), 0, 0, 50)));
}

TEST(PathFile, PicturesAskForWhatTheirPixelsShow)
{
    Path path = planned();
    ASSERT_TRUE(path.detail_by_size);
    path.scene.iterations = 100;
    EXPECT_EQ(scene_of(path, path.frames[0], 1920, 1080).iterations, 100);  // as planned; pictures may need fewer
    const Scene film = picture_of(path, path.frames[0], 1920, 1080);
    const Scene large = picture_of(path, path.frames[0], 3840, 2160);
    EXPECT_LT(film.iterations, 100);
    EXPECT_GE(large.iterations, film.iterations);
    EXPECT_LT(large.detail, film.detail);
    path.scene.iterations = 2;
    EXPECT_EQ(picture_of(path, path.frames[0], 1920, 1080).iterations, 2);
    path.frames[0].changes.iterations = 50;
    EXPECT_EQ(picture_of(path, path.frames[0], 1920, 1080).iterations, 50);
    path.detail_by_size = false;
    path.scene.iterations = 100;
    const Scene asked = picture_of(path, path.frames[1], 1920, 1080);
    EXPECT_EQ(asked.iterations, 100);
    EXPECT_EQ(asked.limits.step_factor, plain_step_factor);
    EXPECT_EQ(asked.limits.root_share, 0);
}

// The picture has 3 x 3 samples for 2 x 2 pixels, so that a pixel is one and a half samples wide, and the middle
// samples belong to both of their neighbours by halves. Row 0 of an image is its bottom row.
TEST(Shrunk, IsTheMeanOverAPixelsArea)
{
    Image picture(3, 3, Image::Layers::bytes);
    for (std::size_t i = 0; i < 9; ++i) {
        for (std::size_t c = 0; c < 3; ++c) picture.bytes()[3 * i + c] = static_cast<std::uint8_t>(10 * i + 80 * c);
    }
    // In both directions the weights of the samples are 2/3 1/3 0 and 0 1/3 2/3. The samples are, from the bottom,
    // 0 10 20 / 30 40 50 / 60 70 80.
    const std::vector<std::uint8_t> red{53, 67, 13, 27};
    for (const int threads : {1, 3}) {
        const auto rgb = shrunk(picture, 2, 2, threads);
        ASSERT_EQ(rgb.size(), 12U);
        for (std::size_t i = 0; i < 4; ++i) {
            EXPECT_EQ(rgb[3 * i], red[i]);
            EXPECT_EQ(rgb[3 * i + 2], red[i] + 160);
        }
    }
    EXPECT_EQ(shrunk(picture, 1, 1, 1)[0], 40);
    EXPECT_EQ(shrunk(picture, 3, 3, 1)[6], 80);
}

TEST(Shrunk, LeavesALargeEvenPictureEven)
{
    for (const auto& [width, height] : {std::pair{1919, 7}, {640, 1081}, {97, 13}}) {
        Image picture(width, height, Image::Layers::bytes);
        std::ranges::fill(picture.bytes(), 255);
        for (const std::uint8_t byte : shrunk(picture, width * 2 / 3, height - 5, 2)) ASSERT_EQ(byte, 255);
    }
}

TEST(Views, KnowThemselvesAndTheirMirrorImages)
{
    const DistanceField field(planned().scene, 0);
    const auto views = views_of(field, planned().frames, 100);
    ASSERT_EQ(views.size(), 4U);
    DepthView mirrored = views[2];
    for (int k = 0; k < view_pixels; ++k) {
        mirrored.depth[static_cast<std::size_t>(k)] =
            views[2].depth[static_cast<std::size_t>(k / view_width * view_width + view_width - 1 - k % view_width)];
    }
    EXPECT_NEAR(likeness(views[2], mirrored), 1, 1e-9);
    EXPECT_LT(likeness(views[0], views[3]), 0.95);
    EXPECT_LT(median_motion(views[2], planned().frames[200], planned().frames[200]), 1e-12);
}

}  // namespace
}  // namespace mandelmarch
