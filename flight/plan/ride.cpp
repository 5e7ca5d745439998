// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/ride.h"

#include <algorithm>
#include <cmath>

#include "flight/plan/tour.h"

namespace mandelmarch {
namespace {

constexpr int samples_per_span = 6;
constexpr double gentle = 0.03;  // the speed's logarithm changes by at most this a frame: twice as fast in 0.8 s
constexpr double foresight = 1;  // clearances ahead and behind whose least counts

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
