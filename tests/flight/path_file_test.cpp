// SPDX-License-Identifier: Apache-2.0
// Invalid path files give an error of one line, with the place and the fault.
#include <gtest/gtest.h>

#include "flight/path/path.h"
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

}  // namespace
}  // namespace mandelmarch
