// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/pacing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "flight/path/path.h"
#include "flight/ride/gaze.h"

namespace mandelmarch {
namespace {

constexpr double wanted_turn = 0.95;    // degrees per frame; the camera slows down if the gaze turns faster
constexpr double slowest = 0.08;        // smallest speed factor
constexpr double usual_motion = 0.014;  // picture heights per frame; wanted median motion of the pixels
constexpr int view_stride = 10;         // frames between the views whose motion sets the speed
constexpr double most_outside = 0.08;   // fraction of the frames; wanted maximum outside the bounds, without easings
constexpr double most_skipped = 0.06;   // fraction of the frames
constexpr int longest_easing = 60;      // frames
constexpr int easings = 40;             // least number of easings in a flight's length

constexpr double stay_reach = 0.75;    // clearances; largest distance from the place during a stay
constexpr int stop_fits = 12;          // attempts to be in time
constexpr double slowest_stay = 0.03;  // smallest speed factor; if it were smaller, the camera would stand still
constexpr double slowest_way = 0.15;   // smallest speed factor between stays
constexpr double stop_in_time = 0.25;  // frames; time error at which the attempts end
constexpr double most_late = 1;        // frames; accepted time error at a stop
constexpr double turning_time = 90;    // frames in which the gaze is mixed with a stop's direction
constexpr double most_beside = 3;      // degrees; accepted angle between the gaze and a stop's direction

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

// Returns the share of stop number `k` in the camera of a frame: 1 during the stay, and 0 during other stays and far
// from it.
double share_of(std::span<const Stop> stops, std::size_t k, double frame)
{
    const Stop& stop = stops[k];
    const double before = k > 0 ? std::max(stop.arrives - stops[k - 1].leaves, 1.0) : turning_time;
    const double after = k + 1 < stops.size() ? std::max(stops[k + 1].arrives - stop.leaves, 1.0) : turning_time;
    const double away = std::max({(stop.arrives - frame) / std::min(before, turning_time),
                                  (frame - stop.leaves) / std::min(after, turning_time), 0.0});
    const double u = 1 - std::min(away, 1.0);
    return u * u * u * (10 - u * (15 - 6 * u));
}

}  // namespace

void slow_turns(Curve& track, const Trajectory& ride, const std::vector<Vector>& views)
{
    std::vector<double> factor(track.slow.size(), 1);
    for (std::size_t i = 1; i < views.size(); ++i) {
        const double turn = degrees_between(views[i - 1], views[i]);
        if (turn <= wanted_turn) continue;
        const auto first = static_cast<std::size_t>(ride.sample[i - 1]);
        const auto last = static_cast<std::size_t>(ride.sample[i]) + 1;
        for (std::size_t s = first; s <= std::min(last, factor.size() - 1); ++s) {
            factor[s] = std::min(factor[s], std::pow(wanted_turn / turn, 1.2));
        }
    }
    for (std::size_t s = 0; s < factor.size(); ++s) track.slow[s] = std::max(slowest, track.slow[s] * factor[s]);
}

void keep_moving(Curve& track, const Trajectory& ride, const std::vector<Frame>& frames, const Director& director)
{
    for (std::size_t i = 0; i + 1 < frames.size(); i += view_stride) {
        const double motion = director.motion(ride.sample[i], frames[i], frames[i + 1]);
        const double wanted = std::clamp(std::pow(usual_motion / std::max(motion, 1e-5), 0.8), 0.4, 2.0);
        const std::size_t end = std::min(i + view_stride, ride.sample.size() - 1);
        for (auto s = static_cast<std::size_t>(ride.sample[i]); s < static_cast<std::size_t>(ride.sample[end]); ++s)
            track.slow[s] = std::clamp(track.slow[s] * wanted, slowest, 1.0);
    }
}

Trajectory ride_without(const Bounds& bounds, const Curve& track, double pace, int frames, int& skip)
{
    Trajectory result = ride(bounds, track, pace, frames + skip);
    skip = std::clamp(static_cast<int>(result.at.size()) - frames, 0, skip);
    result.at.erase(result.at.begin(), result.at.begin() + skip);
    result.sample.erase(result.sample.begin(), result.sample.begin() + skip);
    return result;
}

int shortened_by(const Bounds& bounds, const Trajectory& ride, int frames, int skip)
{
    const auto outside =
        std::count_if(ride.at.begin(), ride.at.begin() + frames, [&](Vector place) { return !bounds.contains(place); });
    const int excess = static_cast<int>(outside) - static_cast<int>(most_outside * frames);
    return std::clamp(skip + excess, 0, static_cast<int>(most_skipped * frames));
}

void ease_ends(Trajectory& ride, int frames)
{
    const double easing = std::min(longest_easing, frames / easings);
    if (easing == 0) return;
    // Returns the frame of the old trajectory at whose place the camera is in a frame of the new one. The speed grows
    // from 0 to its usual value, and falls to 0, linearly.
    const auto old_frame = [=](double frame) {
        const double begun = std::min(frame, easing);
        const double ended = std::clamp(frame - (frames - 1 - easing), 0.0, easing);
        return frame - begun + (begun * begun - ended * ended) / (2 * easing);
    };
    Trajectory eased;
    for (std::size_t i = 0; i < ride.at.size(); ++i) {
        const double old = old_frame(static_cast<double>(i));
        const auto from = static_cast<std::size_t>(old);
        const std::size_t to = std::min(from + 1, ride.at.size() - 1);
        const double share = old - static_cast<double>(from);
        eased.at.push_back((1 - share) * ride.at[from] + share * ride.at[to]);
        eased.sample.push_back((1 - share) * ride.sample[from] + share * ride.sample[to]);
    }
    ride = std::move(eased);
}

double reach_at(const Bounds& bounds, double clearance)
{
    return stay_reach * std::min(clearance, fastest_clearance(bounds));
}

std::vector<Stop> stops_of(const Bounds& bounds, const Curve& track, const Places& places,
                           std::span<const Visit> visits)
{
    std::vector<Stop> stops;
    for (std::size_t i = 0; i < track.places.size(); ++i) {
        const std::size_t middle = track.places[i];
        const Place& place = places.all[i];
        Stop stop{middle, middle,          middle,     place.stay * frames_per_second,
                  {},     visits[i].along, place.lens, place.roll * std::numbers::pi / 180};
        if (place.second) stop.frame = *place.second * frames_per_second;
        if (place.stay > 0) {
            const double reach = reach_at(bounds, track.clearance[middle]);
            const auto near = [&](std::size_t s) { return std::abs(track.length[s] - track.length[middle]) < reach; };
            const std::size_t begin = stops.empty() ? 0 : stops.back().last;
            while (stop.first > begin && near(stop.first - 1)) --stop.first;
            const std::size_t end = i + 1 < track.places.size() ? track.places[i + 1] : track.at.size();
            while (stop.last + 1 < end && near(stop.last + 1)) ++stop.last;
        }
        if (visits[i].starts) {
            stop.first = 0;
            if (place.stay == 0) stop.last = 0;
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
        for (std::size_t i = 0; i < gaze.size(); ++i) {
            const double share = share_of(stops, k, static_cast<double>(i));
            const Vector mixed = (1 - share) * gaze[i] + share * stop.along;
            if (share > 0 && length(mixed) > 1e-6) gaze[i] = unit(mixed);
        }
    }
}

std::vector<double> hold_lens(std::vector<Frame>& frames, std::span<const Stop> stops)
{
    std::vector<double> tilts(frames.size(), 0);
    for (std::size_t k = 0; k < stops.size(); ++k) {
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const double share = share_of(stops, k, static_cast<double>(i));
            frames[i].field_of_view = std::lerp(frames[i].field_of_view, stops[k].lens, share);
            tilts[i] = std::lerp(tilts[i], stops[k].roll, share);
        }
    }
    return tilts;
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
        const auto first = static_cast<std::size_t>(std::lround(stop.arrives));
        const auto last = std::max(first, static_cast<std::size_t>(stop.leaves));
        for (std::size_t f = first; f <= std::min(last, gaze.size() - 1); ++f) {
            if (degrees_between(gaze[f], stop.along) <= most_beside) continue;
            return fmt::format("{}the camera cannot turn to this view in time, expected a later second or more frames",
                               where);
        }
    }
    return "";
}

}  // namespace mandelmarch
