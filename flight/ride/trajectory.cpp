// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/trajectory.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace mandelmarch {
namespace {

constexpr int samples_per_span = 6;
constexpr double gentle = 0.03;       // per frame; largest change of the logarithm of speed: speed doubles in 0.8 s
constexpr double smooth_frames = 15;  // frames; the speed is smoothed over this time on either side
constexpr double foresight = 1;       // the smallest clearance within 0.3 * foresight clearances limits the speed
constexpr int fits = 12;              // attempts to meet the keyframes
constexpr double in_time = 0.25;      // frames; accepted time error at a keyframe
constexpr std::ptrdiff_t even_frames = 45;  // frames; the shape time is averaged over this time on either side

// Returns a speed without kinks that is nowhere larger than `speed`. It is computed in two steps: the minimum within
// smooth_frames on either side, then the weighted mean of the minima over the same range.
std::vector<double> smoothed(const Curve& track, const std::vector<double>& speed)
{
    const std::size_t count = speed.size();
    std::vector<double> time(count, 0);  // frames
    for (std::size_t i = 1; i < count; ++i)
        time[i] = time[i - 1] + (track.length[i] - track.length[i - 1]) * 2 / (speed[i] + speed[i - 1]);
    std::vector<double> least(count);
    std::vector<double> mean(count);
    const auto each = [&](const std::vector<double>& in, auto into) {
        std::size_t first = 0;
        std::size_t last = 0;
        for (std::size_t i = 0; i < count; ++i) {
            while (time[first] < time[i] - smooth_frames) ++first;
            while (last < count && time[last] <= time[i] + smooth_frames) ++last;
            into(i, std::span(in).subspan(first, last - first), std::span(time).subspan(first, last - first));
        }
    };
    each(speed, [&](std::size_t i, auto near, auto) { least[i] = std::ranges::min(near); });
    // The weight of a sample is the product of two factors: its duration, because samples last for unequal times, and a
    // factor that decreases with the distance in time.
    each(least, [&](std::size_t i, auto near, auto at) {
        double sum = 0;
        double weights = 0;
        for (std::size_t k = 0; k < near.size(); ++k) {
            const double lasts = k + 1 < near.size() ? at[k + 1] - at[k] : at[k] - at[std::max<std::size_t>(k, 1) - 1];
            const double weight = lasts * std::max(0.0, 1 - std::abs(at[k] - time[i]) / smooth_frames);
            sum += weight * near[k];
            weights += weight;
        }
        mean[i] = weights > 0 ? std::min(sum / weights, speed[i]) : least[i];
    });
    return mean;
}

// Returns the shape time at a fractional sample of the curve.
double clock_at(const Curve& track, double sample)
{
    const auto i = std::min(static_cast<std::size_t>(sample), track.clock.size() - 1);
    return std::lerp(track.clock[i], track.clock[std::min(i + 1, track.clock.size() - 1)],
                     sample - static_cast<double>(i));
}

// Returns the moving average of the values over `reach` values on either side. At the ends, the values are continued by
// point reflection. Therefore the first and the last value do not change, and values with a constant slope do not
// change either.
std::vector<double> mean_around(const std::vector<double>& values, std::ptrdiff_t reach)
{
    const std::ptrdiff_t last = std::ssize(values) - 1;
    reach = std::min(reach, last);
    const auto at = [&](std::ptrdiff_t i) {
        if (i < 0) return 2 * values.front() - values[static_cast<std::size_t>(-i)];
        if (i > last) return 2 * values.back() - values[static_cast<std::size_t>(2 * last - i)];
        return values[static_cast<std::size_t>(i)];
    };
    std::vector<double> means;
    double sum = 0;
    for (std::ptrdiff_t i = -reach; i < reach; ++i) sum += at(i);
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        sum += at(i + reach);
        means.push_back(sum / static_cast<double>(2 * reach + 1));
        sum -= at(i - reach);
    }
    return means;
}

}  // namespace

Curve track_of(const Shapes& shapes, const Schedule& schedule, const ControlPoints& line)
{
    Curve track;
    for (std::size_t i = 0; i + 3 < line.at.size(); ++i) {
        for (int k = 0; k < samples_per_span; ++k) {
            const double u = static_cast<double>(k) / samples_per_span;
            const double v = 1 - u;
            const auto spline = [&](const auto& points) {
                return (v * v * v / 6) * points[i] + ((3 * u * u * u - 6 * u * u + 4) / 6) * points[i + 1] +
                       ((3 * v * v * v - 6 * v * v + 4) / 6) * points[i + 2] + (u * u * u / 6) * points[i + 3];
            };
            track.at.push_back(spline(line.at));
            track.clock.push_back(spline(line.clock));
            track.value.push_back(schedule.changes() ? schedule.value(track.clock.back()) : shapes.usual());
        }
    }
    // The spline's part i begins near control point i + 1.
    for (const std::size_t i : line.places)
        track.places.push_back((std::max<std::size_t>(i, 1) - 1) * samples_per_span);
    track.clearance.resize(track.at.size());
    shapes.distances(track.at, track.value, track.clearance);
    track.length.resize(track.at.size(), 0);
    for (std::size_t i = 1; i < track.at.size(); ++i) {
        track.length[i] = track.length[i - 1] + length(track.at[i] - track.at[i - 1]);
    }
    track.slow.assign(track.at.size(), 1);
    return track;
}

Trajectory ride(const Bounds& bounds, const Curve& track, double pace, int frames)
{
    const std::size_t count = track.at.size();
    const double cap = fastest_clearance(bounds);
    // The smallest clearance nearby limits the speed, so that the camera is already slow before a narrow place.
    std::vector<double> speed(count);
    for (std::size_t i = 0; i < count; ++i) {
        double least = track.clearance[i];
        const double near = foresight * 0.3 * std::min(track.clearance[i], cap);
        for (std::size_t j = i; j-- > 0 && track.length[i] - track.length[j] < near;)
            least = std::min(least, track.clearance[j]);
        for (std::size_t j = i + 1; j < count && track.length[j] - track.length[i] < near; ++j)
            least = std::min(least, track.clearance[j]);
        speed[i] = pace * std::min(least, cap) * track.slow[i];
    }
    const auto limit = [&](std::size_t i, std::size_t from) {
        const double frames_between = std::abs(track.length[i] - track.length[from]) / speed[from];
        speed[i] = std::min(speed[i], speed[from] * std::exp(gentle * frames_between));
    };
    for (std::size_t i = 1; i < count; ++i) limit(i, i - 1);
    for (std::size_t i = count - 1; i-- > 0;) limit(i, i + 1);

    speed = smoothed(track, speed);

    Trajectory result;
    double time = 0;  // at sample i of the curve, in frames
    for (std::size_t i = 0; i + 1 < count && std::ssize(result.at) < frames; ++i) {
        const double next = time + (track.length[i + 1] - track.length[i]) * 2 / (speed[i] + speed[i + 1]);
        while (static_cast<double>(result.at.size()) < next && std::ssize(result.at) < frames) {
            const double share = (static_cast<double>(result.at.size()) - time) / (next - time);
            result.at.push_back(track.at[i] + share * (track.at[i + 1] - track.at[i]));
            result.sample.push_back(static_cast<double>(i) + share);
        }
        time = next;
    }
    return result;
}

Timed ride_in_time(const Bounds& bounds, Curve& track, double pace, int frames, const Schedule& schedule)
{
    // The film is divided into legs, which end at the keyframes and at the last frame.
    const double last = frames - 1;
    std::vector<double> ends;
    for (const Knot& knot : schedule.knots()) {
        if (knot.frame > 0 && knot.frame < last) ends.push_back(knot.frame);
    }
    ends.push_back(last);
    const auto leg_of = [&](double clock) {
        const auto leg = std::ranges::lower_bound(ends, clock) - ends.begin();
        return static_cast<std::size_t>(std::min(leg, std::ssize(ends) - 1));
    };
    Timed result{};
    for (int round = 0; round < fits; ++round) {
        result.ride = ride(bounds, track, pace, frames * 3);
        // For each leg: the time in frames at which the trajectory passes its end.
        std::vector<double> times(ends.size(), 3 * last);
        for (std::size_t f = 1, leg = 0; f < result.ride.sample.size() && leg < ends.size(); ++f) {
            const double before = clock_at(track, result.ride.sample[f - 1]);
            const double now = clock_at(track, result.ride.sample[f]);
            for (; leg < ends.size() && now >= ends[leg]; ++leg)
                times[leg] = static_cast<double>(f) - (now > before ? (now - ends[leg]) / (now - before) : 0);
        }
        result.off = 0;
        for (std::size_t leg = 0; leg < ends.size(); ++leg)
            result.off = std::max(result.off, std::abs(times[leg] - ends[leg]));
        if (result.off < in_time || round + 1 == fits) break;
        std::vector<double> factors;
        for (std::size_t leg = 0; leg < ends.size(); ++leg) {
            const double took = times[leg] - (leg > 0 ? times[leg - 1] : 0);
            factors.push_back(std::clamp(took / (ends[leg] - (leg > 0 ? ends[leg - 1] : 0)), 0.3, 3.0));
        }
        for (std::size_t s = 0; s < track.slow.size(); ++s)
            track.slow[s] = std::clamp(track.slow[s] * factors[leg_of(track.clock[s])], 0.02, 1.0);
    }
    return result;
}

std::vector<double> clock_of(const Curve& track, const Trajectory& ride, int frames, const Schedule& schedule)
{
    std::vector<double> clock;
    for (int f = 0; f < frames; ++f) clock.push_back(clock_at(track, ride.sample[static_cast<std::size_t>(f)]));
    for (int pass = 0; pass < 2; ++pass) clock = mean_around(clock, even_frames);
    // The averaged shape time is slightly wrong at the keyframes. A correction is added that is exact there and linear
    // in between.
    std::vector<Knot> off;
    const auto add = [&](double frame) {
        const auto f = static_cast<std::size_t>(std::lround(frame));
        if (f < clock.size() && (off.empty() || off.back().frame < frame)) off.push_back({frame, frame - clock[f]});
    };
    add(0);
    for (const Knot& knot : schedule.knots()) add(std::round(knot.frame));
    add(frames - 1);
    for (std::size_t k = 1; k < off.size(); ++k) {
        const auto [from, before] = off[k - 1];
        const auto [to, after] = off[k];
        for (double frame = k == 1 ? from : from + 1; frame <= to; ++frame)
            clock[static_cast<std::size_t>(frame)] += std::lerp(before, after, (frame - from) / (to - from));
    }
    return clock;
}

}  // namespace mandelmarch
