// SPDX-License-Identifier: Apache-2.0
// Moves the camera as keys, mouse and game pad request. Walls can stop the camera.
#pragma once

#include <memory>

#include "core/scene/scene.h"
#include "flight/field/field.h"

namespace mandelmarch::explore {

// The motion that the user requests.
struct MotionInput {
    Vector way;        // velocities to the right, up and forward, as fractions of the speed
    Vector turn;       // rates of turning to the right, turning up and rolling, as fractions of the largest rate
    double yaw = 0;    // radians by which the mouse has been dragged to the right since the last frame
    double pitch = 0;  // radians by which the mouse has been dragged upwards since then
    bool any() const
    {
        return way.x != 0 || way.y != 0 || way.z != 0 || turn.x != 0 || turn.y != 0 || turn.z != 0 || yaw != 0 ||
               pitch != 0;
    }
};

class Motion {
public:
    double speed = 1;      // per second, in units of the distance estimate at the eye
    bool collides = true;  // the camera stops at walls

    // Moves the scene's camera for `seconds`. The velocities follow the requested ones with a delay, so that flights
    // are smooth. Returns false if the camera does not move.
    bool move(Scene& scene, const MotionInput& wish, double seconds);
    // Stops the camera immediately.
    void stop() { way_ = turn_ = {}; }

    // Returns the conservative distance estimate at the scene's eye; 0 inside solid.
    double clearance(const Scene& scene) const;
    // Returns the size of the fractal's bounds.
    double size(const Scene& scene) const { return field(scene).bounds().size; }

private:
    const DistanceField& field(const Scene& scene) const;

    mutable std::unique_ptr<DistanceField> field_;
    Vector way_, turn_;  // current velocities
};

}  // namespace mandelmarch::explore
