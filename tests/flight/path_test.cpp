// SPDX-License-Identifier: Apache-2.0
// Invalid path files give an error of one line, with the place and the fault. A flight at another frame rate visits the
// same places at the same times, and keeps the same promises, whose limits are per second.
#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "flight/path/path.h"
#include "tests/flight/rows.h"
#include "tests/refusal.h"

namespace mandelmarch {
namespace {

const std::string text =
    R"({"format": "mandelmarch path 1", "fractal": "mandelbulb", "seed": 3, "frames_per_second": 30,
"scene": {"detail": "by size", "shape": [0, 4, 8], "iterations": 100, "escape": 100, "colouring": 3, "brightness": 1.2},
"frames": [
{"location": [4, 3, 3], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1},
{"location": [4, 3, 3.1], "look_at": [0, 0, 0], "up": [0, 0, 1], "field_of_view": 1, "brightness": 1.5}
]})";

std::string with(const std::string& from, const std::string& to)
{
    std::string changed = text;
    const auto at = changed.find(from);
    if (at == std::string::npos) throw Error("no " + from);
    return changed.replace(at, from.size(), to);
}

// Replaces `from` by `to` in the text of a valid path file, and checks the error message for the result.
void says(const std::string& from, const std::string& to, const std::string& message)
{
    const std::string refusal = refusal_of([&] { path_from_text(with(from, to), "a.json"); });
    EXPECT_TRUE(refusal.starts_with("a.json: ")) << refusal;
    EXPECT_NE(refusal.find(message), std::string::npos) << refusal;
    EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
    EXPECT_LT(refusal.size(), 600U) << refusal.substr(0, 600);
}

TEST(PathFile, ErrorNamesThePlaceAndTheFault)
{
    says("mandelmarch path 1", "something", "format");
    says("\"mandelbulb\"", "\"mandelbub\"", "mandelbub");
    says("\"iterations\": 100", "\"iterations\": 0", "a.json: scene");
    says("\"location\": [", "\"location\": [1e99, ", "a.json: frame 0");
    says("\"field_of_view\": 1", "\"field_of_view\": 3", "a.json: frame 0");
    says("[0, 4, 8]", "[0, 4, 1e-320]", "a.json: scene: \"shape\" has 1e-320");  // 0 in single precision
    says("\"seed\": 3", "\"seed\": -3", "seed");
    says("{\"location\"", "{{\"location\"", "JSON");
    says("\"seed\"", "\"seed\": 4, \"seed\"", "the key /seed is given twice, expected once");
    says("3.1], ", "3.1], \"up\": [0, 1, 0], ", "the key /frames/1/up is given twice");
    says("\"seed\"", "\"sede\"", "unknown key \"sede\", expected some of format, fractal, seed");
    says("\"detail\"", "\"look_at\"", "a.json: scene: unknown key \"look_at\", expected some of detail");
    says("\"brightness\": 1.5", "\"brightnes\": 1.5", "a.json: frame 1: unknown key \"brightnes\"");
}

// A path file names the estimate with which it was planned. Older files name none: they were planned with the original
// estimate.
TEST(PathFile, HasTheEstimateOfItsPlan)
{
    EXPECT_FALSE(path_from_text(text, "a.json").scene.conservative);
    EXPECT_FALSE(
        path_from_text(with("100, \"col", "100, \"estimate\": \"original\", \"col"), "a.json").scene.conservative);
    const Path path = path_from_text(with("100, \"col", "100, \"estimate\": \"conservative\", \"col"), "a.json");
    EXPECT_TRUE(path.scene.conservative);
    EXPECT_TRUE(path_from_text(to_text(path), "b.json").scene.conservative);
    says("100, \"col", "100, \"estimate\": \"safe\", \"col", "\"estimate\" is \"safe\", expected \"original\"");
    says("100, \"col", "100, \"estimate\": 1, \"col", "\"estimate\" is 1");
}

TEST(PathFile, NeedsEveryKeyButSeedAndRate)
{
    for (const char* member : {"\"detail\": \"by size\", ", "\"shape\": [0, 4, 8], ", "\"iterations\": 100, ",
                               "\"escape\": 100, ", "\"colouring\": 3, "}) {
        const std::string key = std::string(member).substr(0, std::string(member).find(':'));
        says(member, "", "a.json: scene: " + key + " is missing");
    }
    says(", \"brightness\": 1.2", "", "a.json: scene: \"brightness\" is missing");
    says("\"up\": [0, 0, 1], ", "", "a.json: frame 0: \"up\" is missing");
    says("\"fractal\": \"mandelbulb\", ", "", "\"fractal\" is missing");
    const Path path = path_from_text(with("\"seed\": 3, \"frames_per_second\": 30,", ""), "a.json");
    EXPECT_EQ(path.seed, 0U);
    EXPECT_EQ(path.frames.size(), 2U);
}

TEST(PathFile, KeepsItsRate)
{
    const Path path = path_from_text(with("\"frames_per_second\": 30", "\"frames_per_second\": 24"), "a.json");
    EXPECT_EQ(path.frames_per_second, 24);
    EXPECT_EQ(path_from_text(to_text(path), "b.json").frames_per_second, 24);
    for (const char* wrong : {"0", "241", "-30", "29.97", "\"30\""}) {
        says("\"frames_per_second\": 30", std::string("\"frames_per_second\": ") + wrong,
             "expected a whole number from 1");
    }
}

// A path file may contain anything. Deep nesting must not exhaust the stack, and messages must not quote megabytes.
TEST(PathFile, DeepAndLongTextsAreRefused)
{
    const std::string deep(300'000, '[');
    says("\"location\": [4, 3, 3]", "\"location\": " + deep, "deep");
    says("\"mandelmarch path 1\"", deep + std::string(300'000, ']'), "deep");
    const std::string large(5'000'000, 'x');
    for (const std::string what :
         {"\"mandelbulb\"", "\"by size\"", "[4, 3, 3]", "\"seed\"", "\"mandelmarch path 1\""}) {
        says(what, "\"" + large + "\"", "");
    }
    says("[4, 3, 3]", large, "JSON");
    says("[4, 3, 3]", std::string(5'000'000, '9'), "JSON");
    says("\"mandelbulb\"", "\"a\\nb\"", "a\\nb");
}

// Returns a camera on a circle around the Mandelbulb, at an angle in radians.
Frame on_circle(double angle)
{
    Frame frame;
    frame.eye = {4 * std::cos(angle), 4 * std::sin(angle), 1};
    frame.target = {std::cos(angle + 1), std::sin(angle + 1), 0};
    frame.up = {0, 0, 1};
    frame.field_of_view = 1 + 0.1 * std::sin(angle);
    return frame;
}

constexpr double a_frame = 0.01;  // radians per frame

Path circle(int frames)
{
    Path path;
    path.scene = official_scene(fractal_named("mandelbulb"), 16, 9);
    for (int i = 0; i < frames; ++i) path.frames.push_back(on_circle(a_frame * i));
    cut_digits(path);
    return path;
}

class Rates : public testing::TestWithParam<int> {};

TEST_P(Rates, ThePlacesAreThoseOfTheFlight)
{
    const int rate = GetParam();
    const int frames = 4 * rate;
    const Path path = circle(frames_at_rate(frames, frames_per_second, rate));
    const Path other = at_rate(path, frames, rate);
    ASSERT_EQ(other.frames.size(), static_cast<std::size_t>(frames));
    EXPECT_EQ(other.frames_per_second, rate);
    for (int i = 0; i < frames; ++i) {
        const Frame wanted = on_circle(a_frame * i * frames_per_second / rate);
        const Frame& found = other.frames[static_cast<std::size_t>(i)];
        // A natural spline has no curvature at its ends. Therefore it deviates more from the circle there.
        const double most = i < rate / 2 || i > frames - rate / 2 ? 1e-4 : 1e-8;
        EXPECT_LT(length(found.eye - wanted.eye), most) << i;
        EXPECT_LT(length(found.target - wanted.target), most) << i;
        EXPECT_NEAR(found.field_of_view, wanted.field_of_view, most) << i;
    }
}

TEST_P(Rates, PromisesHoldBySecond)
{
    const int rate = GetParam();
    const int frames = 2 * rate;
    const Audit usual = audit_promises(circle(60), 1);
    const Audit other =
        audit_promises(at_rate(circle(frames_at_rate(frames, frames_per_second, rate)), frames, rate), 1);
    for (const std::string name : {"largest step between frames / DE", "largest turn per frame"}) {
        const Row& found = row_of(other, name);
        const Row& wanted = row_of(usual, name);
        EXPECT_NEAR(found.bar * rate, wanted.bar * frames_per_second, 1e-9) << name;
        EXPECT_NEAR(found.value * rate, wanted.value * frames_per_second, 0.01 * wanted.value * frames_per_second)
            << name;
    }
    const std::string standing = "longest time standing still";
    EXPECT_NEAR(row_of(other, standing).value, row_of(usual, standing).value, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Of, Rates, testing::Values(24, 25, 50, 60, 120));

TEST(Rate, TheRateOfAPathChangesNothing)
{
    const Path path = circle(90);
    EXPECT_EQ(to_text(at_rate(path, 90, frames_per_second)), to_text(path));
    EXPECT_EQ(at_rate(path, 1000, 24).frames.size(), 72U);  // the path has time for so many
}

TEST(Rate, AShapeThatChangesIsBetweenTwoFramesShapes)
{
    Path path = circle(3);
    for (std::size_t i = 0; i < 3; ++i) path.frames[i].changes.shape = {0, 4, 8 - static_cast<double>(i)};
    const Path other = at_rate(path, 5, 60);
    for (std::size_t i = 0; i < 5; ++i) {
        ASSERT_TRUE(other.frames[i].changes.shape);
        EXPECT_EQ((*other.frames[i].changes.shape)[2], 8 - 0.5 * static_cast<double>(i));
    }
}

}  // namespace
}  // namespace mandelmarch
