// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/pacing.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

}  // namespace mandelmarch
