// SPDX-License-Identifier: Apache-2.0
// Tests planning, path files and audits. Results must be the same on any number of threads, and every item of an audit
// must be able to fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "flight/audit/motion.h"
#include "flight/audit/views.h"
#include "flight/ride/planner.h"
#include "tests/flight/rows.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

constexpr int frames = 400;

const Path& planned()
{
    static const Path path = plan({.scene = official_scene("bulb", 16, 9), .seed = 3, .frames = frames}).path;
    return path;
}

void move_to(Frame& frame, Vector place)
{
    frame.target = place + (frame.target - frame.eye);
    frame.eye = place;
}

TEST(Plan, TheSameSeedGivesTheSamePathOnAnyNumberOfThreads)
{
    const Scene scene = official_scene("box", 16, 9);
    const Path one = plan({.scene = scene, .seed = 9, .frames = 150, .threads = 1}).path;
    EXPECT_EQ(to_text(one), to_text(plan({.scene = scene, .seed = 9, .frames = 150, .threads = 3}).path));
    // Another seed begins elsewhere, even by the cube's symmetry.
    const Path other = plan({.scene = scene, .seed = 10, .frames = 150, .threads = 3}).path;
    const DistanceField field(scene, 1);
    const auto start = [&](const Path& path) { return field.representative(path.frames.front().eye); };
    EXPECT_GT(length(start(one) - start(other)), 0.2 * field.bounds().size);
}

TEST(Plan, KeepsEveryPromise)
{
    const Audit result = audit(planned(), 1);
    EXPECT_TRUE(result.promises_kept()) << table_of(planned(), result);
    // The audit is the same on any number of threads.
    EXPECT_EQ(json_of(planned(), result), json_of(planned(), audit(planned(), 4)));
}

// Films use the conservative estimate. A flight that is planned with it keeps every promise, and differs from the
// flight that is planned with the original estimate.
TEST(Plan, KeepsEveryPromiseByTheConservativeEstimate)
{
    Scene scene = official_scene("bulb", 16, 9);
    scene.conservative = true;
    const Path path = plan({.scene = scene, .seed = 3, .frames = frames}).path;
    const Audit result = audit(path, 0, 5);
    EXPECT_TRUE(result.promises_kept()) << table_of(path, result);
    EXPECT_NE(to_text(path), to_text(planned()));
}

// The first tour of this seed only repeats a view, so its gaze is chosen again.
TEST(Plan, LooksElsewhereIfATourOnlyRepeatsAView)
{
    Scene scene = official_scene("box", 16, 9);
    scene.conservative = true;
    std::string log;
    const Plan made =
        plan({.scene = scene, .seed = 3, .frames = 7200, .log = [&](const std::string& text) { log += text; }});
    EXPECT_EQ(made.attempts, 1);
    EXPECT_NE(log.find("tour 0: misses the same view again"), std::string::npos);
    EXPECT_NE(log.find("tour 0, looking elsewhere: misses nothing"), std::string::npos);
    const Audit result = audit(made.path, 0, 5);
    EXPECT_TRUE(result.repeated.empty());
    EXPECT_EQ(result.bars_missed(), 0) << table_of(made.path, result);
}

using Frames = std::vector<Frame>;

// Returns the audit of the unchanged planned path, with views of every fifth frame.
const Audit& sound()
{
    static const Audit result = audit(planned(), 0, 5);
    return result;
}

void look_outwards(Frame& frame) { frame.target = frame.eye + unit(frame.eye); }

void look_outwards(Frames& all)
{
    for (Frame& frame : all) look_outwards(frame);
}

// Makes the camera stand still for one step at every tenth frame.
void stumble(Frames& all)
{
    for (std::size_t i = 0; i < all.size(); i += 10) all[i + 1] = all[i];
}

// A change of the planned path's frames, and the item of the audit that must fail because of the change.
struct Fault {
    const char* row;
    std::function<void(Frames&)> spoil;
};

class Faults : public testing::TestWithParam<Fault> {
protected:
    // Returns the audit of the planned path after the change.
    static Audit spoilt()
    {
        Path path = planned();
        GetParam().spoil(path.frames);
        EXPECT_TRUE(row_of(sound(), GetParam().row).kept()) << "fails unspoilt";
        return audit(path, 0, 5);
    }
};

class BrokenPromises : public Faults {};

TEST_P(BrokenPromises, AreFound)
{
    const Audit result = spoilt();
    EXPECT_FALSE(row_of(result, GetParam().row).kept());
    EXPECT_FALSE(result.promises_kept());
}

const Fault broken_promises[] = {
    {"frames inside solid",
     [](Frames& f) {
         move_to(f[200], {0, 0, 0.1});
     }},
    // Both frames are outside the solid, but the straight line between them is not.
    {"frames inside solid",
     [](Frames& f) {
         move_to(f[0], {0, 0, 2});
         move_to(f[1], {0, 0, -2});
     }},
    {"largest step", [](Frames& f) { f.erase(f.begin() + 300, f.begin() + 330); }},
    {"largest turn",
     [](Frames& f) { f[250].target = f[250].eye + unit(f[250].target - f[250].eye + 0.05 * f[250].up); }},
    {"longest time standing", [](Frames& f) { std::fill(f.begin() + 300, f.begin() + 390, f[300]); }},
};
INSTANTIATE_TEST_SUITE_P(Of, BrokenPromises, testing::ValuesIn(broken_promises));

class LowQuality : public Faults {};

TEST_P(LowQuality, IsFound) { EXPECT_FALSE(row_of(spoilt(), GetParam().row).kept()); }

const Fault low_quality[] = {
    {"least DE",
     [](Frames& f) {
         const DistanceField field(planned().scene, 0);
         Vector place = f[300].eye;
         while (field.distance(place) > 0.002) place = place - 0.3 * field.distance(place) * field.uphill(place, 1e-4);
         move_to(f[300], place);
     }},
    {"frames looking more than 60",
     [](Frames& f) {
         for (Frame& frame : f) frame.target = frame.eye - (frame.target - frame.eye);
     }},
    {"dull frames", [](Frames& f) { look_outwards(f); }},
    {"longest time of dull", [](Frames& f) { look_outwards(f); }},
    {"frames under 40 %", [](Frames& f) { look_outwards(f); }},
    {"frames with apparent motion", stumble},
    {"jerk, 95 of 100", stumble},
    {"angular jerk",
     [](Frames& f) {
         for (std::size_t i = 0; i < f.size(); i += 10) f[i].target = f[i].target + 0.01 * f[i].up;
     }},
    {"frames with a horizon",
     [](Frames& f) {
         for (Frame& frame : f) frame.up = cross(frame.target - frame.eye, frame.up);
     }},
    // The camera is far away, and the fractal appears in a corner of the picture, 30 degrees from its middle.
    {"longest time with the subject at the edge",
     [](Frames& f) {
         for (Frame& frame : f) {
             move_to(frame, {0, 0, 12});
             frame.target = frame.eye + Vector{0.8, 0.4, -1};
         }
     }},
    // After a part of the path, the camera looks at the sky. Then the same part is repeated.
    {"the same view again",
     [](Frames& f) {
         for (std::size_t i = 200; i < 290; ++i) look_outwards(f[i]);
         std::copy(f.begin() + 110, f.begin() + 200, f.begin() + 290);
     }},
    {"frames at the cap",
     [](Frames& f) {
         for (std::size_t i = 0; i + 1 < f.size(); ++i) {
             const double angle = 1.19 * std::acos(-1.0) / 180 * static_cast<double>(i);
             f[i].target = f[i].eye + Vector{std::cos(angle), std::sin(angle), 0};
             f[i].up = {0, 0, 1};
         }
     }},
};
INSTANTIATE_TEST_SUITE_P(Of, LowQuality, testing::ValuesIn(low_quality));

// The first 300 frames of this short flight are outside the hull, and the others inside. Without the first 300 frames
// the audit's item is kept. If the other frames are moved outside, the item is not kept.
TEST(Audit, FramesOutsideTheHullAreFound)
{
    Path path = planned();
    path.frames.erase(path.frames.begin(), path.frames.begin() + 300);
    EXPECT_TRUE(row_of(audit(path, 0, 5), "frames inside the hull").kept());
    for (Frame& frame : path.frames) move_to(frame, unit(frame.eye) + unit(frame.eye));
    EXPECT_FALSE(row_of(audit(path, 0, 5), "frames inside the hull").kept());
}

// A flight of ten seconds need not have a passage. A flight of full length needs some. It has none if its camera stands
// still, and then the audit's item is not kept.
TEST(Audit, MissingPassagesAreFound)
{
    EXPECT_TRUE(row_of(sound(), "distinct passages").kept());
    Path path = planned();
    path.frames.assign(7200, planned().frames[0]);
    EXPECT_FALSE(row_of(audit(path, 0, 300), "distinct passages").kept());
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
    EXPECT_NE(json_of(path, audit(path, 0, 50)), json_of(planned(), audit(planned(), 0, 50)));
}

TEST(PathFile, PicturesHaveTheIterationsThatTheirPixelsShow)
{
    Path path = planned();
    ASSERT_TRUE(path.detail_by_size);
    path.scene.iterations = 100;
    EXPECT_EQ(scene_of(path, path.frames[0], 1920, 1080).iterations, 100);  // as in planning; pictures need fewer
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
    const Scene given = picture_of(path, path.frames[1], 1920, 1080);
    EXPECT_EQ(given.iterations, 100);
    EXPECT_EQ(given.limits.step_factor, plain_step_factor);
    EXPECT_EQ(given.limits.root_share, 0);
}

TEST(Views, AreLikeTheirMirrorImages)
{
    const DistanceField field(planned().scene, 0);
    const auto view = [&](std::size_t frame) { return view_of(field, planned().frames[frame]); };
    const DepthView seen = view(200);
    DepthView mirrored = seen;
    for (int k = 0; k < view_pixels; ++k) {
        mirrored.depth[static_cast<std::size_t>(k)] =
            seen.depth[static_cast<std::size_t>(k / view_width * view_width + view_width - 1 - k % view_width)];
    }
    EXPECT_NEAR(likeness(LogDepths(seen), LogDepths(mirrored)), 1, 1e-9);
    EXPECT_LT(likeness(LogDepths(view(0)), LogDepths(view(300))), 0.95);
    EXPECT_LT(median_motion(seen, planned().frames[200], planned().frames[200]), 1e-12);
}

}  // namespace
}  // namespace mandelmarch
