// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/ride.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "flight/plan/tour.h"

namespace mandelmarch {
namespace {

constexpr int samples_per_span = 6;
constexpr double gentle = 0.03;       // the speed's logarithm changes by at most this a frame: twice as fast in 0.8 s
constexpr double smooth_frames = 15;  // the speed is smoothed over so many before and behind
constexpr double foresight = 1;       // clearances ahead and behind whose least counts

// The speed without its kinks and nowhere above it: the least within a quarter of a second before and behind, then the
// mean over as long.
std::vector<double> smoothed(const Track& track, const std::vector<double>& speed)
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
    // Samples lie at unequal times: each counts by how long it lasts, less the farther it is.
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

}  // namespace

Track track_of(const Field& field, const std::vector<Vector>& points)
{
    Track track;
    for (std::size_t i = 0; i + 3 < points.size(); ++i) {
        for (int k = 0; k < samples_per_span; ++k) {
            const double u = static_cast<double>(k) / samples_per_span;
            const double v = 1 - u;
            track.at.push_back((v * v * v / 6) * points[i] + ((3 * u * u * u - 6 * u * u + 4) / 6) * points[i + 1] +
                               ((3 * v * v * v - 6 * v * v + 4) / 6) * points[i + 2] + (u * u * u / 6) * points[i + 3]);
        }
    }
    track.clearance.resize(track.at.size());
    field.distances(track.at, track.clearance);
    track.length.resize(track.at.size(), 0);
    for (std::size_t i = 1; i < track.at.size(); ++i) {
        track.length[i] = track.length[i - 1] + length(track.at[i] - track.at[i - 1]);
    }
    track.slow.assign(track.at.size(), 1);
    return track;
}

Ride ride(const Field& field, const Track& track, double pace, int frames)
{
    const std::size_t count = track.at.size();
    const double cap = fastest_clearance(field.hull());
    // The least clearance nearby, so that a sudden narrow place does not meet a fast camera.
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

    Ride result;
    double time = 0;  // frames, at sample i
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

}  // namespace mandelmarch
