// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/gaze.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace mandelmarch {
namespace {

constexpr double blur = 24;               // frames; standard deviation of the smoothing in time
constexpr std::size_t middle_until = 90;  // frames; from then on the gaze is no longer drawn to the fractal's centre

constexpr double most_roll = 0.25;     // degrees per frame; so small that a roll and a turn together stay within 1.2
constexpr double roll_share = 0.02;    // fraction of the tilt that is corrected per frame
constexpr double clear_horizon = 0.5;  // the first frame whose Tilt::horizon is larger sets the initial roll

// Returns the values smoothed by a Gaussian in time that is cut off at three standard deviations. At the ends, the
// first and the last value are repeated.
template <class Value>
std::vector<Value> blurred(const std::vector<Value>& in)
{
    const int half = static_cast<int>(3 * blur);
    const int count = static_cast<int>(in.size());
    std::vector<double> weights;
    for (int k = -half; k <= half; ++k) weights.push_back(std::exp(-0.5 * k * k / (blur * blur)));
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<Value> out(in.size());
    for (int i = 0; i < count; ++i) {
        Value& sum = out[static_cast<std::size_t>(i)];
        int k = -half;
        for (const double weight : weights) {
            sum = sum + weight / total * in[static_cast<std::size_t>(std::clamp(i + k, 0, count - 1))];
            ++k;
        }
    }
    return out;
}

// Returns the unit vector a, rotated towards the unit vector b by `angle` radians.
Vector turned(Vector a, Vector b, double angle)
{
    const Vector side = b - dot(a, b) * a;
    const double size = length(side);
    if (!(size > 1e-12)) return a;
    return unit(std::cos(angle) * a + (std::sin(angle) / size) * side);
}

}  // namespace

double degrees_between(Vector a, Vector b)
{
    return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

Vector ahead(const Trajectory& ride, std::size_t frame, std::size_t frames)
{
    const std::size_t to = std::min(frame + frames, ride.at.size() - 1);
    const Vector way = ride.at[to] - ride.at[std::min(frame, to - 1)];
    return length(way) > 0 ? unit(way) : Vector{1, 0, 0};
}

std::vector<Vector> smoothed_gaze(const Trajectory& ride, std::vector<Vector> aims, bool from_outside)
{
    for (std::size_t i = 0; from_outside && i < std::min(aims.size(), middle_until); ++i) {
        const double share =
            0.5 + 0.5 * std::cos(static_cast<double>(i) * std::numbers::pi / static_cast<double>(middle_until));
        const Vector aim = (1 - share) * aims[i] + share * unit(-1 * ride.at[i]);
        if (length(aim) > 1e-6) aims[i] = unit(aim);
    }
    aims = blurred(aims);
    std::ranges::transform(aims, aims.begin(), unit);
    return aims;
}

void limit_turns(std::vector<Vector>& gaze, double most)
{
    for (std::size_t i = 1; i < gaze.size(); ++i) {
        if (degrees_between(gaze[i - 1], gaze[i]) > most)
            gaze[i] = turned(gaze[i - 1], gaze[i], most * std::numbers::pi / 180);
    }
}

std::vector<Frame> cameras(const Trajectory& ride, const std::vector<Vector>& gaze, Vector up, double field_of_view)
{
    std::vector<Frame> frames;
    for (std::size_t i = 0; i < gaze.size(); ++i) {
        if (i > 0) {
            // Rotates `up` by the smallest rotation that maps the gaze of the previous frame onto that of this frame
            // (Rodrigues' formula without trigonometric functions).
            const Vector axis = cross(gaze[i - 1], gaze[i]);
            const double cosine = dot(gaze[i - 1], gaze[i]);
            up = cosine * up + cross(axis, up) + (dot(axis, up) / (1 + cosine)) * axis;
        }
        up = unit(up - dot(up, gaze[i]) * gaze[i]);
        Frame frame;
        frame.eye = ride.at[i];
        frame.target = ride.at[i] + gaze[i];
        frame.up = up;
        frame.field_of_view = field_of_view;
        frames.push_back(frame);
    }
    return frames;
}

void hold_level(std::vector<Frame>& frames, const Fractal& fractal, const std::vector<double>& tilts)
{
    const double most = most_roll * std::numbers::pi / 180;
    double roll = 0;  // radians
    const auto wanted = [&](std::size_t i) { return tilts.empty() ? 0 : tilts[i]; };
    for (std::size_t i = 0; i < frames.size(); ++i) {
        if (const Tilt tilt = tilt_of(frames[i], fractal); tilt.horizon > clear_horizon) {
            roll = tilt.angle - wanted(i);
            break;
        }
    }
    std::vector<double> rolls;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Tilt tilt = tilt_of(rolled(frames[i], roll), fractal);
        roll += std::clamp(roll_share * tilt.horizon * (tilt.angle - wanted(i)), -most, most);
        rolls.push_back(roll);
    }
    rolls = blurred(rolls);
    for (std::size_t i = 0; i < frames.size(); ++i) frames[i] = rolled(frames[i], rolls[i]);
}

}  // namespace mandelmarch
