// SPDX-License-Identifier: Apache-2.0
// Parts of the explorer that need no window.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>

#include "apps/explore/actions/actions.h"
#include "apps/explore/model/files.h"
#include "apps/explore/model/motion.h"
#include "apps/explore/model/path_editor.h"
#include "apps/explore/model/shown_view.h"
#include "apps/explore/view/resolution_control.h"
#include "apps/survey.h"
#include "backends/all.h"
#include "core/os/files.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/error.h"
#include "flight/audit/audit.h"
#include "flight/path/places.h"

namespace mandelmarch::explore {
namespace {

constexpr double tick = 1.0 / 60;  // seconds

Scene official(const char* name) { return official_scene(fractal_named(name), 16, 9); }

// Flies straight ahead for a minute at maximum speed. Returns the smallest clearance on the way.
double clearance_after_a_minute(Motion& motion, Scene& scene)
{
    motion.speed = 16;
    double least = motion.clearance(scene);
    for (int i = 0; i < 3600; ++i) {
        motion.move(scene, {.way = {0, 0, 1}, .turn = {}}, tick);
        least = std::min(least, motion.clearance(scene));
    }
    return least;
}

TEST(Places, ViewsAreAppendedToAFile)
{
    const TemporaryFolder folder;
    const std::string file = folder.path() / "places.csv";
    Scene scene = official("bulb");
    EXPECT_EQ(append_place(file, scene), 1U);
    std::ofstream(file, std::ios::app) << "tour";  // by hand, without an end of line
    scene.eye = {1, 2, 3};
    scene.field_of_view = 0.5;
    EXPECT_EQ(append_place(file, scene), 2U);
    const Places places = read_places(file);
    EXPECT_EQ(places.all[1].eye, scene.eye);
    EXPECT_EQ(places.all[1].target, scene.target);
    EXPECT_EQ(places.all[1].lens, 0.5);
    EXPECT_TRUE(places.all[1].tour);
    std::ofstream(file) << "something else\n";
    EXPECT_THROW(append_place(file, scene), InputError);
    const std::string other = "location_y,location_x,location_z,look_at_x,look_at_y,look_at_z,second,stay\n";
    std::ofstream(file) << other;
    EXPECT_THROW(append_place(file, scene), InputError);
    EXPECT_EQ(std::filesystem::file_size(file), other.size());
}

TEST(ExploreMotion, WallsStopTheFlight)
{
    for (const char* fractal : {"bulb", "box"}) {
        Scene scene = official(fractal);
        Motion motion;
        EXPECT_GT(clearance_after_a_minute(motion, scene), 0) << fractal;
    }
    // Negative control: without the stop at walls, a flight straight ahead enters the solid.
    Scene scene = official("bulb");
    Motion motion;
    motion.collides = false;
    EXPECT_LE(clearance_after_a_minute(motion, scene), 0);
}

TEST(ExploreSight, ReportsWhatAPictureCannotShow)
{
    Scene scene = official("bulb");
    const double clearance = Motion().clearance(scene);
    for (const Precision precision : {Precision::f64, Precision::f32}) {
        EXPECT_EQ(view_warning(scene, clearance, precision, false), "");
        EXPECT_NE(view_warning(scene, clearance, precision, true).find("nothing is in view"), std::string::npos);
    }
    scene.detail = -8;
    EXPECT_NE(view_warning(scene, 1e-6, Precision::f32, false).find("double"), std::string::npos);
    EXPECT_EQ(view_warning(scene, 1e-6, Precision::f64, false), "");
    for (const char* fractal : {"bulb", "box"}) {
        Scene inside = official(fractal);
        inside.eye = {0.1, 0.1, 0.1};
        inside.target = {1, 2, 3};
        EXPECT_NE(view_warning(inside, Motion().clearance(inside), Precision::f64, true).find("inside the solid"),
                  std::string::npos)
            << fractal;
    }
}

TEST(ExploreMotion, TurningRoundFourTimesLooksTheSameWay)
{
    Scene scene = official("box");
    const Vector before = unit(scene.target - scene.eye);
    Motion motion;
    for (int i = 0; i < 4; ++i) {
        MotionInput wish;
        wish.yaw = std::numbers::pi / 2;
        motion.move(scene, wish, tick);
        if (i == 1) {
            EXPECT_LT(dot(before, unit(scene.target - scene.eye)), 0.9);
        }
    }
    EXPECT_NEAR(dot(before, unit(scene.target - scene.eye)), 1, 1e-9);
}

TEST(ExplorePace, PicturesFitTheTimeThatThereIs)
{
    ResolutionControl resolution;
    for (int i = 0; i < 8; ++i) resolution.took(100'000, 0.010);
    const auto [width, height] = resolution.size(960, 540, 0.012);
    EXPECT_LE(resolution.expected(static_cast<double>(width) * height), 0.012);
    EXPECT_GT(resolution.expected(1.2 * width * height), 0.012);
    EXPECT_EQ(resolution.size(960, 540, 1), std::pair(960, 540));
    // On a busy machine, some pictures wait for a core.
    for (int i = 0; i < 12; ++i) resolution.took(10'000, i % 3 == 0 ? 0.05 : 0.001);
    EXPECT_GT(resolution.size(960, 540, 0.012).first, 400);
    // If a quarter of the width takes longer than wanted, but not long, it is kept.
    for (int i = 0; i < 6; ++i) resolution.took(6'000, 0.01);
    EXPECT_EQ(resolution.size(960, 540, 0.012), std::pair(240, 135));
    for (int i = 0; i < 6; ++i) resolution.took(6'000, 1);
    EXPECT_EQ(resolution.size(960, 540, 0.012), std::pair(80, 45));
}

// Returns a path like one that is flown with an unsteady hand, and faster than the audit allows.
Path unsteady()
{
    Path path;
    path.scene = official("box");
    path.scene.conservative = true;
    for (int i = 0; i < 200; ++i) {
        const double t = i / 199.0;
        const double tremor = i % 2 == 0 ? 0.02 : -0.02;
        Frame frame;
        frame.eye = {14 - 16 * t, 8 + tremor, 10 - 16 * t};
        frame.target = frame.eye + Vector{-1 + tremor, -0.5 + 0.4 * std::sin(12 * t), -0.7};
        frame.up = {0, 1, 0};
        path.frames.push_back(frame);
    }
    return path;
}

TEST(ExplorePaths, SmoothingKeepsThePromisesThatTheHandBreaks)
{
    const Path path = unsteady();
    EXPECT_FALSE(audit_promises(path, 1).promises_kept());
    const Path smooth = smoothed(path);
    const Audit audit = audit_promises(smooth, 1);
    EXPECT_TRUE(audit.promises_kept()) << table_of(smooth, audit);
    EXPECT_LT(length(smooth.frames.front().eye - path.frames.front().eye), 1e-6);
    EXPECT_LT(length(smooth.frames.back().eye - path.frames.back().eye), 0.5);
}

TEST(ExplorePaths, ARecordingHasThirtyFramesASecond)
{
    Scene scene = official("bulb");
    PathEditor path_editor;
    path_editor.begin_recording(scene);
    for (int i = 0; i < 120; ++i) {
        scene.eye.x += 0.001;
        scene.target.x += 0.001;
        path_editor.record(scene, tick);
    }
    path_editor.end_recording();
    EXPECT_NEAR(static_cast<double>(path_editor.frames()), 61, 1);
    EXPECT_NEAR(path_editor.path().frames.back().eye.x, scene.eye.x, 0.003);
}

TEST(ExploreActions, NamesAndKeysAreUnique)
{
    std::set<std::string_view> names;
    for (const Action& action : actions()) {
        EXPECT_TRUE(names.insert(action.name).second) << action.name;
        EXPECT_TRUE(action.key.empty() || names.insert(action.key).second) << action.key;
        EXPECT_EQ(action_named(action.name), &action);
    }
    EXPECT_EQ(action_named("fly"), nullptr);
}

// A model with the openmp backend alone, whose files go to a folder of its own.
class ExploreModel : public testing::Test {
protected:
    void perform(const char* action) { action_named(action)->perform(model); }

    const TemporaryFolder folder;
    Settings settings{.setup = {"openmp", 0, Precision::f64, Mode::exact}};
    // Tasks may use the registry until the process ends.
    const Registry& registry = *new Registry([] {
        std::vector<std::unique_ptr<Backend>> backends;
        backends.push_back(make_openmp_backend());
        return backends;
    }());
    Model model{registry, settings, folder.path(), official("box")};
};

TEST_F(ExploreModel, AFileKeepsItsLookAndAWrongFileTheView)
{
    const std::string file = folder.path() / "view.dat";
    Scene plain = official("bulb");
    plain.colouring = 1;
    std::ofstream(file) << view_text(plain);
    model.open(file);
    perform("reset-view");
    EXPECT_EQ(model.view.scene().fractal->name, "mandelbulb");
    EXPECT_EQ(model.view.scene().colouring, 1);
    std::ofstream(file) << "1 2 3\n1 2\n";
    model.open(file);
    EXPECT_EQ(model.view.scene().colouring, 1);
    EXPECT_TRUE(model.said().starts_with(file + ":2: ")) << model.said();
}

TEST_F(ExploreModel, StartViewsFollowOneAnother)
{
    std::set<std::string> said;
    for (std::size_t i = 0; i < start_views().size(); ++i) {
        perform("next-view");
        said.insert(model.said());
    }
    EXPECT_EQ(said.size(), start_views().size());
    perform("next-view");
    EXPECT_EQ(model.said(), fmt::format("{}, {}", start_views()[0].name, start_views()[0].fractal));
}

TEST(ExploreViews, ANarrowPaneShowsTheWidthOfThePictureThatFillsTheWindow)
{
    ShownView view(official("box"), {});
    view.set_size(600, 400, 1.5);
    EXPECT_EQ(view.shown(), view.scene());
    const double whole = length(camera_of(view.shown()).across);
    view.set_size(299, 400, 1.5);
    EXPECT_NEAR(length(camera_of(view.shown()).across), whole, 1e-12);
    // Negative control: the view's own field of view cuts off the sides.
    EXPECT_LT(length(camera_of(view.scene()).across), 0.51 * whole);
    EXPECT_EQ(view.scene().field_of_view, official("box").field_of_view);
}

TEST(ExploreViews, StartViewsHaveTheDefaultLookAndAreOutsideTheSolid)
{
    EXPECT_FALSE(start_views().empty());
    for (const StartView& start : start_views()) {
        Scene scene = parse_parameters(start.text, std::string(start.name), fractal_named(start.fractal)).scene;
        EXPECT_EQ(scene.colouring, default_look) << start.name;
        EXPECT_GT(Motion().clearance(scene), 0) << start.name;
    }
}

TEST(ExploreViews, SavedTextReadsAsTheSameView)
{
    Scene scene = official("bulb");
    scene.eye.x = 1.2345678901234567;
    scene.colouring = 3;
    scene.image_file = "view.png";
    const Scene read = view_of_text(view_text(scene), "view.dat", fractal_named("box"));
    EXPECT_EQ(read.fractal->name, "mandelbulb");
    EXPECT_EQ(read.eye.x, scene.eye.x);
    EXPECT_EQ(read.colouring, 3);
    EXPECT_FALSE(read.conservative);
    scene.conservative = true;
    EXPECT_TRUE(view_of_text(view_text(scene), "view.dat", fractal_named("box")).conservative);
}

TEST(ExploreSettings, AreKeptAndAnInvalidFileGivesAMessage)
{
    const TemporaryFolder folder;
    const std::string file = folder.path() / "mandelmarch/explore.json";
    Settings settings;
    settings.speed = 2;
    settings.look = 4;
    settings.setup = {"vulkan", 1, Precision::f64, Mode::exact};
    write_settings(file, settings);
    std::string said;
    const Settings read = read_settings(file, said);
    EXPECT_EQ(read.setup, settings.setup);
    EXPECT_EQ(read.speed, 2);
    EXPECT_EQ(read.look, 4);
    EXPECT_EQ(said, "");
    std::ofstream(file) << "{\"width\": \"wide\"}";
    EXPECT_EQ(read_settings(file, said).speed, 1);
    EXPECT_NE(said.find("not a settings file"), std::string::npos);
    std::ofstream(file) << "{\"look\": 99}";
    EXPECT_LT(read_settings(file, said).look, colouring_types);
    std::ofstream(file) << "{\"width\": 65535, \"look\": 4}";
    EXPECT_EQ(read_settings(file, said).width, Settings().width);
    EXPECT_NE(said.find("explore.json: the window is too large"), std::string::npos);
    said.clear();
    EXPECT_EQ(read_settings(folder.path(), said).look, default_look);
    EXPECT_NE(said.find("not a settings file"), std::string::npos) << "a folder";
    std::ofstream(file) << "{}";
    EXPECT_EQ(read_settings(file, said).look, default_look);
}

TEST(ExploreNames, AreFreeOfLinksThatLeadNowhere)
{
    const TemporaryFolder folder;
    std::filesystem::create_symlink("missing", folder.path() / "view-001.png");
    EXPECT_EQ(free_name(folder.path(), "view"), folder.path() / "view-002");
}

}  // namespace
}  // namespace mandelmarch::explore
