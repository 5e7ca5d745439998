// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/visits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "flight/audit/runs.h"
#include "flight/audit/views.h"
#include "flight/path/path.h"
#include "flight/plan/director.h"
#include "flight/plan/gaze.h"
#include "flight/plan/search.h"

namespace mandelmarch {
namespace {

constexpr double stay_reach = 0.75;  // clearances; largest distance from the place during a stay
constexpr std::array straights{3.0, 2.0, 1.4, 1.0, 0.75, 0.5, 0.35, 0.2, 0.1};  // clearances; see straight_at()
constexpr double straight_share = 0.5;   // smallest clearance on such a way, as a fraction of the place's
constexpr double least_shown = 0.05;     // fraction of the picture's middle that shows the fractal
constexpr std::size_t balls_tried = 20;  // for the nearest place that can be reached
constexpr int parts_of_a_way = 32;       // on the way from such a ball's centre to the place
constexpr int free_gates = 3;            // number of gates on a tour to a place without a second
constexpr int stop_fits = 12;            // attempts to be in time
constexpr double slowest_stay = 0.03;    // smallest speed factor; if it were smaller, the camera would stand still
constexpr double slowest_way = 0.15;     // smallest speed factor between stays
constexpr double stop_in_time = 0.25;    // frames; time error at which the attempts end
constexpr double most_late = 1;          // frames; accepted time error at a stop
constexpr double turning_time = 90;      // frames in which the gaze is mixed with a stop's direction
constexpr double most_beside = 3;        // degrees; accepted angle between the gaze and a stop's direction

double reach_at(const Bounds& bounds, double clearance)
{
    return stay_reach * std::min(clearance, fastest_clearance(bounds));
}

std::string text_of(Vector p) { return fmt::format("{:.6g},{:.6g},{:.6g}", p.x, p.y, p.z); }

// Returns how far a camera at a place can fly straight ahead in a direction; 0 if the place is too narrow.
double straight_at(const DistanceField& field, Vector place, Vector along, double least)
{
    const double clearance = field.distance(place);
    if (clearance < least) return 0;
    const double floor = std::max(least, straight_share * clearance);
    for (const double share : straights) {
        const Vector way = share * std::min(clearance, fastest_clearance(field.bounds())) * along;
        if (field.least_between(place, place + way, floor) > floor) return length(way);
    }
    return 0;
}

bool shows(const DistanceField& field, Vector eye, Vector along)
{
    const Vector up = std::abs(along.y) < 0.7 ? Vector{0, 1, 0} : Vector{0, 0, 1};
    return view_of(field, {eye, eye + along, up, 1, {}}).middle_hit_share() >= least_shown;
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
        const double before = straight_at(roads_.field, place.eye, -1 * along, least_);
        const double after = straight_at(roads_.field, place.eye, along, least_);
        if (ball < 0 || before <= 0 || after <= 0) refuse(place, along);
        if (!shows(roads_.field, place.eye, along)) refuse_view(place, along);
        return {place.eye, along, before, after, ball, false, 0, std::numeric_limits<double>::infinity()};
    }

private:
    // Returns a ball with a free way to the place; -1 if a camera from outside cannot get there.
    int ball_at(Vector place) const
    {
        const int ball = search_.near(0, place).ball;
        return ball >= 0 && reached(ball) ? ball : -1;
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
                if (straight_at(roads_.field, there, along, least_) <= 0 ||
                    straight_at(roads_.field, there, -1 * along, least_) <= 0 || ball_at(there) < 0) {
                    continue;
                }
                least = length(there - place.eye);
                best = there;
                break;
            }
        }
        const double clearance = roads_.field.distance(place.eye);
        throw InputError(
            fmt::format("{}:{}: the camera cannot reach the location {}, {}; the nearest that it can reach is {}",
                        places_.file, place.line, text_of(place.eye),
                        clearance <= in_solid * roads_.field.bounds().size ? "inside the fractal"
                        : clearance < least_                               ? "too close to a wall"
                                                                           : "to which no free way leads",
                        text_of(best)));
    }

    [[noreturn]] void refuse_view(const Place& place, Vector along) const
    {
        const Sphere sphere(512, 0.1);
        std::vector<Vector> all = sphere.directions();
        std::ranges::sort(all, [along](Vector a, Vector b) { return dot(a, along) > dot(b, along); });
        const auto seen = std::ranges::find_if(all, [&](Vector d) { return shows(roads_.field, place.eye, d); });
        const std::string nearest = seen == all.end()
                                        ? "no direction does"
                                        : "the nearest direction that does has the look_at " +
                                              text_of(place.eye + length(place.target - place.eye) * *seen);
        throw InputError(
            fmt::format("{}:{}: the view from {} to {} does not show the fractal in the picture's middle; {}",
                        places_.file, place.line, text_of(place.eye), text_of(place.target), nearest));
    }

    const Places& places_;
    const Roadmap& roads_;
    double least_;
    Search search_;
};

// Returns the time, in frames, at which a trajectory passes a sample of the curve; `never` if it ends before.
double time_at(const Trajectory& ride, std::size_t sample, double never)
{
    const auto after = std::ranges::lower_bound(ride.sample, static_cast<double>(sample));
    if (after == ride.sample.end()) return never;
    const auto f = after - ride.sample.begin();
    if (f == 0) return 0;
    const double before = ride.sample[static_cast<std::size_t>(f - 1)];
    return static_cast<double>(f) - (*after - static_cast<double>(sample)) / (*after - before);
}

// Multiplies the speed factors of samples from `first` to before `last` so that they take `wanted` frames. No factor
// falls below `least`.
void scale_time(Curve& track, std::size_t first, std::size_t last, double took, double wanted, double least)
{
    const double factor = wanted > 0 ? std::clamp(took / wanted, 0.3, 3.0) : 3.0;
    for (std::size_t s = first; s < last; ++s) track.slow[s] = std::clamp(track.slow[s] * factor, least, 1.0);
}

}  // namespace

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

std::vector<Stop> stops_of(const Bounds& bounds, const Curve& track, const Places& places,
                           std::span<const Visit> visits)
{
    std::vector<Stop> stops;
    for (std::size_t i = 0; i < track.places.size(); ++i) {
        const std::size_t middle = track.places[i];
        const Place& place = places.all[i];
        Stop stop{middle, middle, middle, place.stay * frames_per_second, {}, visits[i].along, 0, 0};
        if (place.second) stop.frame = *place.second * frames_per_second;
        if (place.stay > 0) {
            const double reach = reach_at(bounds, track.clearance[middle]);
            const auto near = [&](std::size_t s) { return std::abs(track.length[s] - track.length[middle]) < reach; };
            const std::size_t begin = stops.empty() ? 0 : stops.back().last;
            while (stop.first > begin && near(stop.first - 1)) --stop.first;
            while (stop.last + 1 < track.at.size() && near(stop.last + 1)) ++stop.last;
        }
        stops.push_back(stop);
    }
    return stops;
}

Timed ride_to_stops(const Bounds& bounds, Curve& track, double pace, int frames, std::span<Stop> stops)
{
    Timed result{};
    for (int round = 0; round < stop_fits; ++round) {
        const double never = 3.0 * frames;
        result = {ride(bounds, track, pace, 3 * frames), 0};
        for (Stop& stop : stops) {
            stop.arrives = time_at(result.ride, stop.first, never);
            stop.leaves = time_at(result.ride, stop.last, never);
            if (stop.frame) result.off = std::max(result.off, std::abs(stop.arrives - *stop.frame));
            result.off = std::max(result.off, std::abs(stop.leaves - stop.arrives - stop.stay));
        }
        if (result.off < stop_in_time || round + 1 == stop_fits) break;
        // Between two moments that are given, all parts of the way outside stays get the same factor.
        double begin = 0;      // frame of the last given moment
        std::size_t next = 0;  // first stop after it
        std::size_t from = 0;  // sample at that moment
        double stays = 0;      // frames of the stays since then
        for (std::size_t i = 0; i < stops.size(); ++i) {
            if (const auto& frame = stops[i].frame) {
                const double took = stops[i].arrives - begin - stays;
                for (std::size_t k = next; k <= i; ++k) {
                    scale_time(track, k == next ? from : stops[k - 1].last, stops[k].first, took,
                               *frame - begin - stays, slowest_way);
                }
                begin = stops[i].leaves;
                next = i + 1;
                from = stops[i].last;
                stays = 0;
            } else {
                stays += stops[i].leaves - stops[i].arrives;
            }
        }
        for (const Stop& stop : stops) {
            scale_time(track, stop.first, stop.last, stop.leaves - stop.arrives, stop.stay, slowest_stay);
        }
    }
    return result;
}

void hold_gaze(std::vector<Vector>& gaze, std::span<const Stop> stops)
{
    for (std::size_t k = 0; k < stops.size(); ++k) {
        const Stop& stop = stops[k];
        // The gaze of the stays before and after this one is left as it is.
        const double before = k > 0 ? stop.arrives - stops[k - 1].leaves : turning_time;
        const double after = k + 1 < stops.size() ? stops[k + 1].arrives - stop.leaves : turning_time;
        for (std::size_t i = 0; i < gaze.size(); ++i) {
            const auto frame = static_cast<double>(i);
            const double away = std::max({(stop.arrives - frame) / std::min(before, turning_time),
                                          (frame - stop.leaves) / std::min(after, turning_time), 0.0});
            const double u = 1 - std::min(away, 1.0);
            const double share = u * u * u * (10 - u * (15 - 6 * u));
            const Vector mixed = (1 - share) * gaze[i] + share * stop.along;
            if (share > 0 && length(mixed) > 1e-6) gaze[i] = unit(mixed);
        }
    }
}

std::string missed_stop(const Places& places, std::span<const Stop> stops, std::span<const Vector> gaze)
{
    for (std::size_t i = 0; i < stops.size(); ++i) {
        const Stop& stop = stops[i];
        const std::string where = fmt::format("{}:{}: ", places.file, places.all[i].line);
        if (stop.frame && std::abs(stop.arrives - *stop.frame) > most_late) {
            const bool late = stop.arrives > *stop.frame;
            const double tenths = stop.arrives / frames_per_second * 10;
            return fmt::format("{}second is {}, but the flight arrives {} {:.1f} s, expected {}", where,
                               *places.all[i].second, late ? "only at" : "as early as",
                               (late ? std::ceil(tenths) : std::floor(tenths)) / 10,
                               late ? "a later second or a place less far away"
                                    : "an earlier second or a line 'tour' before the place");
        }
        if (stop.stay - (stop.leaves - stop.arrives) > most_late) {
            return fmt::format("{}stay is {}, but the camera passes the place in {:.1f} s, expected less", where,
                               places.all[i].stay, (stop.leaves - stop.arrives) / frames_per_second);
        }
        if (stop.leaves > static_cast<double>(gaze.size())) {
            return fmt::format("{}the flight leaves the place at {:.1f} s, after the film's end, expected more frames",
                               where, stop.leaves / frames_per_second);
        }
        for (auto f = static_cast<std::size_t>(stop.arrives + 0.5);
             f < gaze.size() && static_cast<double>(f) <= stop.leaves; ++f) {
            if (degrees_between(gaze[f], stop.along) <= most_beside) continue;
            return fmt::format("{}the camera cannot turn to this view in time, expected a later second or more frames",
                               where);
        }
    }
    return "";
}

}  // namespace mandelmarch
