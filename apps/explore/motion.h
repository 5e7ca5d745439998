// SPDX-License-Identifier: Apache-2.0
// The motion of the camera by keys, mouse and game pad, with collision.
#pragma once

#include <memory>

#include "core/scene/scene.h"
#include "flight/field/field.h"

namespace mandelmarch::explore {

// Requested motion.
struct MotionInput {
    Vector way;        // velocity to the right, up and forward: -1 to 1
    Vector turn;       // rate of turning right, up and roll: -1 to 1
    double yaw = 0;    // immediate turn by dragging, radians
    double pitch = 0;  // immediate turn by dragging, radians
    bool any() const
    {
        return way.x != 0 || way.y != 0 || way.z != 0 || turn.x != 0 || turn.y != 0 || turn.z != 0 || yaw != 0 ||
               pitch != 0;
    }
};

class Motion {
public:
    double speed = 1;      // distance estimates per second
    bool collides = true;  // stops at walls

    // Moves the scene's camera for `seconds`; returns false if it does not move. Velocities follow the requested ones
    // with a delay, so that flights are smooth.
    bool move(Scene& scene, const MotionInput& wish, double seconds);
    // Stops immediately.
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
