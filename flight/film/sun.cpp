// SPDX-License-Identifier: Apache-2.0
#include "flight/film/sun.h"

#include <cmath>
#include <numbers>

namespace mandelmarch {
namespace {

constexpr int directions = 24;            // of the sun that are compared
constexpr std::size_t frames_apart = 30;  // frames from one compared frame to the next
constexpr double against = 0.5;           // weight of a sun in front of the camera; one behind it has weight 1

// Returns the quality of a frame's light: 1 for a sun at right angles to the gaze, 0 for one along it.
double worth(Vector sun, Vector gaze)
{
    const double cosine = dot(sun, gaze);
    return (1 - cosine * cosine) * (cosine > 0 ? against : 1);
}

}  // namespace

Vector sun_of(const Path& path)
{
    const Vector usual = Scene{}.sun;
    const double level = std::hypot(usual.x, usual.z);
    Vector best = usual;
    double most = 0;
    for (int i = 0; i < directions; ++i) {
        const double angle = 2 * std::numbers::pi * i / directions;
        const Vector sun{level * std::sin(angle), usual.y, level * std::cos(angle)};
        double sum = 0;
        for (std::size_t frame = 0; frame < path.frames.size(); frame += frames_apart) {
            sum += worth(sun, unit(path.frames[frame].target - path.frames[frame].eye));
        }
        if (sum > most) {
            most = sum;
            best = sun;
        }
    }
    return best;
}

}  // namespace mandelmarch
