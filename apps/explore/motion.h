// SPDX-License-Identifier: Apache-2.0
// The camera in flight: where keys, mouse and game pad lead it, and how far it may go.
#pragma once

#include <memory>

#include "core/scene/scene.h"
#include "flight/field/field.h"

namespace mandelmarch::explore {

// What the hands ask for: each -1 to 1, but for the angles of a drag.
struct Wish {
    Vector way;        // to the right, up and forward
    Vector turn;       // right, up and roll
    double yaw = 0;    // radians, at once
    double pitch = 0;  // radians, at once
    bool any() const
    {
        return way.x != 0 || way.y != 0 || way.z != 0 || turn.x != 0 || turn.y != 0 || turn.z != 0 || yaw != 0 ||
               pitch != 0;
    }
};

class Motion {
public:
    double speed = 1;      // distance estimates a second
    bool collides = true;  // flies through no wall

    // Moves the scene's camera for `seconds`; false where it stayed where it was. Keys take a moment to take effect and
    // to wear off, so that flights are smooth.
    bool move(Scene& scene, const Wish& wish, double seconds);
    // What is left of a movement goes.
    void stop() { way_ = turn_ = {}; }

    // The distance estimate at the scene's eye, the conservative one; 0 inside solid.
    double clearance(const Scene& scene) const;
    // The size of what holds the fractal.
    double size(const Scene& scene) const { return field(scene).hull().size; }

private:
    const Field& field(const Scene& scene) const;

    mutable std::unique_ptr<Field> field_;
    Vector way_, turn_;  // as it is taken up
};

}  // namespace mandelmarch::explore
