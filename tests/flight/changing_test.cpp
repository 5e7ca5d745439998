// SPDX-License-Identifier: Apache-2.0
// Flights through a fractal that changes its shape: schedules of the change, plans, and faults that an audit must find.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flight/field/field.h"
#include "flight/ride/planner.h"
#include "flight/route/random.h"
#include "tests/flight/rows.h"
#include "tests/refusal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

constexpr int frames = 300;

Schedule scale(const std::string& text) { return parse_schedule("scale", text, official_scene("box", 16, 9), frames); }

Path planned_on(int threads)
{
    return plan({.scene = official_scene("box", 16, 9),
                 .schedule = scale("2:2.03"),
                 .seed = 4,
                 .frames = frames,
                 .threads = threads})
        .path;
}

const Path& planned()
{
    static const Path path = planned_on(0);
    return path;
}

const std::string solid = "frames inside solid";
const std::string walls = "largest change of DE between frames by the shape";

// Returns the largest change, from one frame to the next, of the rate at which the value changes.
template <class Value>
double rate_jump(Value value)
{
    double worst = 0;
    for (int f = 1; f + 1 < frames; ++f) worst = std::max(worst, std::abs(value(f + 1) - 2 * value(f) + value(f - 1)));
    return worst;
}

TEST(Schedule, GoesFromValueToValueWithoutJumpsInItsRate)
{
    const Schedule there = scale("2:2.4");
    EXPECT_EQ(there.value(0), 2);
    EXPECT_EQ(there.value(frames - 1), static_cast<float>(2.4));
    const Schedule back = scale("1s=2,5s=2.4,8s=2");
    for (const auto& [frame, value] : {std::pair{0.0, 2.0}, {30.0, 2.0}, {150.0, 2.4}, {240.0, 2.0}, {299.0, 2.0}})
        EXPECT_NEAR(back.value(frame), value, 1e-6) << frame;
    // The value changes fastest where it changes by 0.4 in 90 frames. There the largest rate is 1.5 times the mean
    // rate.
    const double rate = 1.5 * 0.4 / 90;
    EXPECT_LT(rate_jump([&](int f) { return back.value(f); }), 0.05 * rate);
    // Negative control: with linear interpolation the rate jumps.
    EXPECT_GT(rate_jump([](int f) { return 2 + 0.4 * std::clamp((f - 30) / 120.0, 0.0, 1.0); }), 0.4 * rate);
    EXPECT_TRUE(back.changes());
    EXPECT_FALSE(scale("2.5").changes());
    EXPECT_FALSE(Schedule{}.changes());
}

// plan() refuses these shapes, even if they do not change during the flight.
TEST(Plan, RefusesShapesThatCannotBeFlownThrough)
{
    for (const double value : {0.5, -0.5, 0.9}) {
        Scene box = official_scene("box", 16, 9);
        box.shape[0] = value;
        EXPECT_THROW(plan({.scene = box, .frames = frames}), InputError) << value;
        EXPECT_NE(flight_objection(box).find("expected another scale"), std::string::npos);
        EXPECT_THROW(scale(std::to_string(value)), InputError);
    }
    EXPECT_EQ(flight_objection(official_scene("box", 16, 9)), "");
    EXPECT_EQ(flight_objection(official_scene("julia", 16, 9)), "");
}

TEST(Plan, EndsWhenItsProcessorTimeIsSpent)
{
    const Scene box = official_scene("box", 16, 9);
    const std::string refusal = refusal_of([&] { plan({.scene = box, .frames = frames, .most_seconds = 1e-3}); });
    EXPECT_NE(refusal.find("processor time"), std::string::npos) << refusal;
    const std::string changing =
        refusal_of([&] { plan({.scene = box, .schedule = scale("2:2.03"), .frames = frames, .most_seconds = 1e-3}); });
    EXPECT_NE(changing.find("more frames"), std::string::npos) << changing;
}

TEST(Schedule, RefusesNonsenseInOneLine)
{
    for (const char* text : {"",           "x",          "2:",        ":2",   "2:3:4",          "nan",
                             "2:1e9",      "0s=2,=3",    "0s=2,5=3",  "5s",   "0s=2,3s=3,3s=2", "5s=2,3s=3",
                             "-1s=2",      "0s=2,11s=3", "2:1",       "2:-2", "2:0.5",          "2,3",
                             "0s=2,,5s=3", "2:3:",       "0s=2,5s=3,"}) {
        const std::string refusal = refusal_of([&] { scale(text); });
        EXPECT_EQ(refusal.find('\n'), std::string::npos) << refusal;
        EXPECT_TRUE(refusal.starts_with("--scale: ")) << text << ": " << refusal;
    }
    EXPECT_THROW(parse_schedule("power", "8:5", official_scene("box", 16, 9), frames), InputError);
    // Negative controls: these schedules are valid.
    for (const char* text : {"2", "2:3", "-1.5:-2", "0s=2,10s=3"}) EXPECT_NO_THROW(scale(text)) << text;
}

TEST(ChangingPlan, KeepsEveryPromiseAndItsValues)
{
    const Path& path = planned();
    const Audit result = audit(path, 0, 5);
    EXPECT_TRUE(result.promises_kept()) << table_of(path, result);
    // Ten seconds suffice to get inside.
    EXPECT_GT(row_of(result, "frames inside the hull").value, 40);
    EXPECT_EQ(path.frames.size(), static_cast<std::size_t>(frames));
    const auto value = [&](std::size_t i) { return scene_of(path, path.frames[i], 16, 9).shape[0]; };
    EXPECT_EQ(value(0), 2);
    EXPECT_EQ(value(frames - 1), static_cast<float>(2.03));
    // The value never decreases, and its rate does not jump: from frame to frame the rate changes by little, compared
    // with the mean rate, 1e-4 per frame.
    for (std::size_t i = 1; i < frames; ++i) EXPECT_GE(value(i), value(i - 1));
    EXPECT_LT(rate_jump([&](int f) { return value(static_cast<std::size_t>(f)); }), 1e-5);
    EXPECT_EQ(to_text(path), to_text(path_from_text(to_text(path), "a.json")));
}

TEST(ChangingPlan, IsTheSameOnAnyNumberOfThreads) { EXPECT_EQ(to_text(planned()), to_text(planned_on(1))); }

// A path is planned for a constant shape, but then the shape changes during the flight. The audit must detect a broken
// promise.
TEST(ChangingAudit, APathThatIgnoresTheChangeBreaksAPromise)
{
    Path path = plan({.scene = official_scene("box", 16, 9), .seed = 9, .frames = frames}).path;
    ASSERT_TRUE(audit_promises(path, 0).promises_kept());
    // With this change of the scale, the hull's size grows from 6 to 8.7.
    const Schedule schedule = scale("2:1.6");
    for (std::size_t i = 0; i < path.frames.size(); ++i)
        path.frames[i].changes.shape = {static_cast<float>(schedule.value(static_cast<double>(i))), 0.5, 1};
    EXPECT_FALSE(audit_promises(path, 0).promises_kept());
}

TEST(ChangingAudit, AShapeThatJumpsIsFound)
{
    Path path = planned();
    EXPECT_TRUE(row_of(audit_promises(path, 0), walls).kept());
    for (std::size_t i = 150; i < path.frames.size(); ++i) (*path.frames[i].changes.shape)[0] += 0.15;
    EXPECT_FALSE(row_of(audit_promises(path, 0), walls).kept());
}

// The fractal changes its shape between two frames, and its wall sweeps over the camera. At both frames the camera is
// outside the solid, but between them it is inside. The audit must detect this. Negative control: at places that stay
// outside, it must not.
TEST(ChangingAudit, AWallThatSweepsOverTheCameraIsFound)
{
    Path path;
    path.scene = official_scene("bulb", 16, 9);
    const auto clearance = [&](Vector p, double power) {
        Scene scene = path.scene;
        scene.shape[2] = power;
        return DistanceField(scene, 1).distance(p);
    };
    const auto swept = [&](Vector place) {
        path.frames.assign(2, {place, place + Vector{1, 0, 0}, {0, 0, 1}, 1, {}});
        path.frames[1].changes.shape = {0, 4, 7};
        return !row_of(audit_promises(path, 1), solid).kept();
    };
    FlightRandom random(1);
    int found = 0;
    int free = 0;
    for (int i = 0; i < 4000 && (found < 3 || free < 3); ++i) {
        const auto along = [&] { return 2.4 * random.share() - 1.2; };
        const double x = along();
        const double y = along();
        const Vector place{x, y, along()};
        if (std::min(clearance(place, 8), clearance(place, 7)) < 0.01) continue;
        if (clearance(place, 7.5) <= 0) {
            EXPECT_TRUE(swept(place)) << i;
            ++found;
        } else if (length(place) > 1.25) {
            EXPECT_FALSE(swept(place)) << i;
            ++free;
        }
    }
    EXPECT_GE(found, 3);
    EXPECT_GE(free, 3);
}

}  // namespace
}  // namespace mandelmarch
