// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/visits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/text/error.h"
#include "flight/audit/motion.h"
#include "flight/audit/views.h"
#include "flight/path/path.h"
#include "flight/ride/director.h"
#include "flight/ride/gaze.h"
#include "flight/ride/pacing.h"
#include "flight/route/search.h"

namespace mandelmarch {
namespace {

constexpr std::array straights{3.0, 2.0, 1.4, 1.0, 0.75, 0.5, 0.35, 0.2, 0.1};  // clearances; see Visitor::straight()
constexpr double straight_share = 0.5;   // smallest clearance on such a way, as a fraction of the place's
constexpr double least_shown = 0.05;     // fraction of the picture's middle that shows the fractal
constexpr std::size_t balls_tried = 20;  // for the nearest place that can be reached
constexpr int parts_of_a_way = 32;       // on the way from such a ball's centre to the place
constexpr int free_gates = 3;            // number of gates on a tour to a place without a second

std::string text_of(Vector p) { return fmt::format("{:.6g},{:.6g},{:.6g}", p.x, p.y, p.z); }

bool shows(const DistanceField& field, Vector eye, Vector along)
{
    return view_of(field, {eye, eye + along, first_up(along), 1, {}}).middle_hit_share() >= least_shown;
}

// Returns the nearest of some places around a location that is wide enough for a camera.
Vector nearest_free(const DistanceField& field, Vector location, double least)
{
    const Sphere sphere(512, 0.1);
    for (double away = least;; away *= 1.1) {
        for (const Vector direction : sphere.directions()) {
            const Vector there = location + away * direction;
            if (field.distance(there) > 2 * least) return there;
        }
    }
}

// Returns a message about a place at which a camera cannot be in time, or from which it sees nothing; "" if it can.
std::string fault_of(const Place& place, const DistanceField& field, double least, int frames)
{
    const Vector along = unit(place.target - place.eye);
    const double clearance = field.distance(place.eye);
    if (place.second && *place.second * frames_per_second >= frames) {
        return fmt::format("second is {}, but the film has {:.4g} s, expected less or more frames", *place.second,
                           static_cast<double>(frames) / frames_per_second);
    }
    if (clearance < least) {
        return fmt::format("the camera cannot reach the location {}, {}; the nearest free place is {}",
                           text_of(place.eye),
                           clearance <= in_solid * field.bounds().size ? "inside the fractal" : "too close to a wall",
                           text_of(nearest_free(field, place.eye, least)));
    }
    if (shows(field, place.eye, along)) return {};
    const Sphere sphere(512, 0.1);
    std::vector<Vector> all = sphere.directions();
    std::ranges::sort(all, [along](Vector a, Vector b) { return dot(a, along) > dot(b, along); });
    const auto seen = std::ranges::find_if(all, [&](Vector d) { return shows(field, place.eye, d); });
    return fmt::format("the view from {} to {} does not show the fractal in the picture's middle; {}",
                       text_of(place.eye), text_of(place.target),
                       seen == all.end() ? "no direction does"
                                         : "the nearest direction that does has the look_at " +
                                               text_of(place.eye + length(place.target - place.eye) * *seen));
}

// Finds the visits of places in a roadmap.
class Visitor {
public:
    Visitor(const Places& places, const RoadmapSpan& roads, double least)
        : places_(places), roads_(*roads.roads), least_(least), search_(std::span(&roads, 1), 0)
    {
    }

    Visit visit(const Place& place) const
    {
        const Vector along = unit(place.target - place.eye);
        const int ball = ball_at(place.eye);
        const double before = straight(place.eye, -1 * along, ball);
        const double after = straight(place.eye, along, ball);
        if (before <= 0 || after <= 0) refuse(place, along);
        return {place.eye, along, before, after, ball, false, 0, std::numeric_limits<double>::infinity()};
    }

private:
    // Returns a ball with a free way to the place; -1 if a camera from outside cannot get there.
    int ball_at(Vector place) const
    {
        const int ball = search_.near(0, place).ball;
        return ball >= 0 && reached(ball) ? ball : -1;
    }

    // Returns how far a camera at a place can fly straight ahead in a direction, to a point that has a free way to the
    // place's ball. Returns 0 if the place is too narrow or has no ball (-1).
    double straight(Vector place, Vector along, int ball) const
    {
        const double clearance = roads_.field.distance(place);
        if (ball < 0 || clearance < least_) return 0;
        const double floor = std::max(least_, straight_share * clearance);
        const Vector centre = roads_.balls.balls()[static_cast<std::size_t>(ball)].centre;
        for (const double share : straights) {
            const Vector way = share * std::min(clearance, fastest_clearance(roads_.field.bounds())) * along;
            if (roads_.field.least_between(place, place + way, floor) > floor &&
                search_.is_free(0, place + way, centre)) {
                return length(way);
            }
        }
        return 0;
    }

    bool reached(int ball) const
    {
        return roads_.balls.holding(roads_.balls.balls()[static_cast<std::size_t>(ball)].centre) >= 0;
    }

    [[noreturn]] void refuse(const Place& place, Vector along) const
    {
        const std::vector<Ball>& balls = roads_.balls.balls();
        std::vector<std::pair<double, int>> nearest;
        for (std::size_t b = 0; b < balls.size(); ++b) {
            if (!reached(static_cast<int>(b))) continue;
            const double apart = length(balls[b].centre - place.eye);
            nearest.emplace_back(apart - roads_.field.safety() * balls[b].clearance, static_cast<int>(b));
        }
        std::ranges::sort(nearest);
        if (nearest.size() > balls_tried) nearest.resize(balls_tried);
        Vector best{};
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [apart, b] : nearest) {
            const Vector centre = balls[static_cast<std::size_t>(b)].centre;
            for (int part = parts_of_a_way; part >= 0; --part) {
                const Vector there = centre + (static_cast<double>(part) / parts_of_a_way) * (place.eye - centre);
                if (length(there - place.eye) >= least) break;
                const int ball = ball_at(there);
                if (straight(there, along, ball) <= 0 || straight(there, -1 * along, ball) <= 0) continue;
                least = length(there - place.eye);
                best = there;
                break;
            }
        }
        throw InputError(fmt::format(
            "{}:{}: the camera cannot reach the location {}, to which no free way leads{}", places_.file, place.line,
            text_of(place.eye), std::isfinite(least) ? "; the nearest that it can reach is " + text_of(best) : ""));
    }

    const Places& places_;
    const Roadmap& roads_;
    double least_;
    Search search_;
};

}  // namespace

void check_places(const Places& places, const DistanceField& field, double least, int frames)
{
    std::vector<std::string> faults;
    for (const Place& place : places.all) {
        const std::string fault = fault_of(place, field, least, frames);
        if (!fault.empty()) faults.push_back(fmt::format("{}:{}: {}", places.file, place.line, fault));
    }
    refuse_faults(std::move(faults));
}

std::vector<Visit> visits_of(const Places& places, const RoadmapSpan& roads, double least)
{
    std::vector<Visit> visits;
    if (places.all.empty()) return visits;
    const Visitor visitor(places, roads, least);
    for (const Place& place : places.all) visits.push_back(visitor.visit(place));
    if (Visit& first = visits.front(); places.all.front().second == 0) {
        first.starts = true;
        const DistanceField& field = roads.roads->field;
        first.before = std::min(first.before, reach_at(field.bounds(), field.distance(first.place)));
    }
    return visits;
}

void give_gates(std::span<Visit> visits, const Places& places, double pace)
{
    std::optional<double> known = 0;  // seconds; end of the last stay, if it is known
    for (std::size_t i = 0; i < visits.size(); ++i) {
        const Place& place = places.all[i];
        const bool timed = known && place.second;
        visits[i].gates = !place.tour ? 0 : timed ? std::numeric_limits<int>::max() : free_gates;
        visits[i].longest =
            timed ? (*place.second - *known) * frames_per_second * pace : std::numeric_limits<double>::infinity();
        known = place.second;
        if (known) *known += place.stay;
    }
}

}  // namespace mandelmarch
