// SPDX-License-Identifier: Apache-2.0
// Flights that visit places, and places that no flight can visit.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <regex>

#include "flight/audit/audit.h"
#include "flight/path/places.h"
#include "flight/ride/gaze.h"
#include "flight/ride/planner.h"
#include "flight/ride/visits.h"
#include "tests/refusal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

constexpr int frames = 1800;

// The lines of the views ravine and terraces, a tour, and the view temple (scenes).
const std::string ravine = "5.273290104,1.387809562,5.400536058,4.976588959,0.5206696182,5.000490125,";
const std::string terraces = "4.59089102,3.307132358,5.499079091,5.128894500,2.524955920,5.184830343,";
const std::string temple = "5.401487322,0.7248474461,5.063691376,4.732755850,0.9379517075,5.776000853,";

Places places(const std::string& lines)
{
    return places_from_text(std::string(places_header) + "\n" + lines, "places.csv");
}

Scene box() { return official_scene("box", 16, 9); }

const Places& given()
{
    static const Places all = places(ravine + "0,3,0.6,20\n" + terraces + "24,2\ntour\n" + temple + "50,2\n");
    return all;
}

const Path& visiting()
{
    static const Path path = plan({.scene = box(), .seed = 3, .frames = frames, .places = given()}).path;
    return path;
}

// Returns the number of places that the flight misses: in a frame of the stay, the camera is farther from the place
// than three quarters of a clearance, or looks more than 3 degrees beside it.
int missed(const Path& path)
{
    const DistanceField field(path.scene, 1);
    int count = 0;
    for (const Place& place : given().all) {
        const double reach = 0.75 * std::min(field.distance(place.eye), fastest_clearance(field.bounds()));
        const auto first = static_cast<std::size_t>(*place.second * frames_per_second) + 1;
        const auto last = std::min(static_cast<std::size_t>((*place.second + place.stay) * frames_per_second) - 1,
                                   path.frames.size() - 1);
        bool met = true;
        for (std::size_t i = first; i <= last; ++i) {
            const Frame& frame = path.frames[i];
            const double beside = degrees_between(unit(frame.target - frame.eye), unit(place.target - place.eye));
            met = met && length(frame.eye - place.eye) < 1.05 * reach && beside < 3.1;
        }
        count += met ? 0 : 1;
    }
    return count;
}

TEST(Visits, PlacesAreReachedInTimeAndSeenDuringTheStay)
{
    EXPECT_EQ(missed(visiting()), 0);
    // The camera begins with the lens and the roll of the first place. It is level with the usual lens in the tour.
    EXPECT_NEAR(visiting().frames[45].field_of_view, 0.6, 1e-9);
    EXPECT_EQ(visiting().frames[1200].field_of_view, 1);
    const auto roll = [](std::size_t frame) {
        return tilt_of(visiting().frames[frame], *box().fractal).angle * 180 / std::numbers::pi;
    };
    EXPECT_NEAR(roll(45), 20, 3);
    EXPECT_NEAR(roll(1200), 0, 10);
    // The flight ends at the end of the last stay.
    EXPECT_NEAR(static_cast<double>(visiting().frames.size()), 52 * frames_per_second, 2);
    // Negative controls: a flight that begins a second later, and one that looks elsewhere.
    Path late = visiting();
    late.frames.erase(late.frames.begin(), late.frames.begin() + frames_per_second);
    EXPECT_GT(missed(late), 0);
    Path beside = visiting();
    for (Frame& frame : beside.frames) frame.target = frame.target + 0.1 * frame.up;
    EXPECT_GT(missed(beside), 0);
}

TEST(Visits, FlightCanBeginAtAPlaceWithoutAStay)
{
    const Path path =
        plan({.scene = box(), .seed = 3, .frames = frames, .places = places(ravine + "0,0\n" + terraces + ",2\n")})
            .path;
    const DistanceField field(path.scene, 1);
    const Place first = places(ravine + "0,0\n").all.front();
    EXPECT_LT(length(path.frames.front().eye - first.eye), field.distance(first.eye));
}

TEST(Visits, FlightKeepsEveryPromise)
{
    const Audit result = audit(visiting(), 0, 5);
    EXPECT_TRUE(result.promises_kept()) << table_of(visiting(), result);
}

// Returns the message with which a search for the places of these lines ends; "" if all can be visited.
std::string refusal(const std::string& lines)
{
    static const Shapes shapes(box(), 0, 0);
    static const RoadmapSet roads(shapes, {});
    return refusal_of([&] {
        check_places(places(lines), shapes.field(), 0.0034 * shapes.field().bounds().size, 9000);
        visits_of(places(lines), roads.stretches(1).front(), 0.0034 * shapes.field().bounds().size);
    });
}

TEST(Visits, PlaceOutOfReachIsNamedWithTheNearestInReach)
{
    EXPECT_EQ(refusal(ravine + "\n" + temple + "\n"), "");
    const std::string look = ",0,0,0,,\n";
    const std::string inside = refusal(ravine + "\n0.3,0.2,0.1" + look);
    EXPECT_TRUE(inside.starts_with("places.csv:3: the camera cannot reach the location 0.3,0.2,0.1, inside")) << inside;
    std::smatch nearest;
    ASSERT_TRUE(std::regex_search(inside, nearest, std::regex("nearest free place is ([-.0-9,e]+)$"))) << inside;
    // That place is in a hollow.
    const std::string hollow = refusal(nearest[1].str() + look);
    ASSERT_TRUE(std::regex_search(hollow, nearest, std::regex("free way leads; .* can reach is ([-.0-9,e]+)$")))
        << hollow;
    EXPECT_EQ(refusal(nearest[1].str() + look), "");
    // All faults are in one message.
    const std::string both = refusal("0.3,0.2,0.1" + look + ravine + "\n6.9,0,0,10,0,0,,\n");
    EXPECT_TRUE(std::regex_search(both, std::regex("^places.csv:2: .*; places.csv:4: the view from"))) << both;
}

TEST(Visits, ViewOfTheSkyIsNamedWithTheNearestViewOfTheFractal)
{
    const std::string sky = refusal("6.9,0,0,10,0,0,,\n");
    EXPECT_TRUE(sky.starts_with("places.csv:2: the view from 6.9,0,0 to 10,0,0 does not show")) << sky;
    std::smatch nearest;
    ASSERT_TRUE(std::regex_search(sky, nearest, std::regex("has the look_at ([-.0-9,e]+)$"))) << sky;
    EXPECT_EQ(refusal("6.9,0,0," + nearest[1].str() + ",,\n"), "");
}

TEST(Visits, PlaceThatComesTooSoonOrTooLateIsNamedWithTheTimeOfTheArrival)
{
    const auto message = [&](const std::string& lines, int most) {
        return refusal_of([&] { plan({.scene = box(), .seed = 3, .frames = most, .places = places(lines)}); });
    };
    const std::string soon = message(ravine + "0,1\n" + terraces + "2,1\n", frames);
    EXPECT_TRUE(soon.starts_with("places.csv:3: second is 2, but the flight arrives only at ")) << soon;
    const std::string after_end = message(ravine + "0,1\n" + terraces + "60,1\n", frames);
    EXPECT_EQ(after_end, "places.csv:3: second is 60, but the film has 60 s, expected less or more frames");
    const std::string late = message(ravine + "0,1\n" + terraces + "300,1\n", 10'000);
    EXPECT_TRUE(late.starts_with("places.csv:3: second is 300, but the flight arrives as early as ")) << late;
    const auto change = [&] {
        plan({.scene = box(),
              .schedule = parse_schedule("scale", "2:2.1", box(), frames),
              .frames = frames,
              .places = given()});
    };
    EXPECT_EQ(refusal_of(change), "places.csv: the shape changes in flight, expected a constant shape");
}

}  // namespace
}  // namespace mandelmarch
