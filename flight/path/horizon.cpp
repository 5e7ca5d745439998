// SPDX-License-Identifier: Apache-2.0
#include "flight/path/horizon.h"

#include <cmath>

#include "core/scene/fractal.h"

namespace mandelmarch {

Tilt tilt_of(const Frame& frame, Vector upward)
{
    const Vector gaze = unit(frame.target - frame.eye);
    const Vector up = unit(frame.up - dot(frame.up, gaze) * gaze);
    const Vector level = upward - dot(upward, gaze) * gaze;
    return {std::atan2(dot(cross(up, level), gaze), dot(up, level)), dot(level, level)};
}

Tilt tilt_of(const Frame& frame, const Fractal& fractal)
{
    return tilt_of(frame, fractal.flight.upward(frame.eye, frame.up));
}

Frame rolled(Frame frame, double angle)
{
    const Vector gaze = unit(frame.target - frame.eye);
    frame.up = std::cos(angle) * frame.up + std::sin(angle) * cross(gaze, frame.up);
    return frame;
}

}  // namespace mandelmarch
