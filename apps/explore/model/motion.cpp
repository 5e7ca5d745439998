// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/motion.h"

#include <algorithm>
#include <cmath>

#include "core/render/kernel_scene.h"

namespace mandelmarch::explore {
namespace {

constexpr double turning = 0.8;      // radians per second, as in the report's viewer
constexpr double inertia = 0.12;     // seconds; time constant with which velocities follow the input
constexpr double nearest = 1e-5;     // fractal sizes; the speed is computed with at least this clearance
constexpr double most_of_way = 0.5;  // largest step, as a fraction of the distance that is certainly free
constexpr double still = 1e-3;       // a smaller velocity is set to 0 if no motion is requested

Vector towards(Vector now, Vector wish, double share)
{
    const Vector next = now + share * (wish - now);
    return length(next) < still && length(wish) == 0 ? Vector{} : next;
}

// Returns v rotated about a unit axis by an angle in radians.
Vector turned(Vector v, Vector axis, double angle)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return c * v + s * cross(axis, v) + (dot(axis, v) * (1 - c)) * axis;
}

bool same_fractal(const Scene& a, const Scene& b)
{
    return a.fractal == b.fractal && a.shape == b.shape && a.iterations == b.iterations && a.escape == b.escape;
}

}  // namespace

const DistanceField& Motion::field(const Scene& scene) const
{
    if (field_ == nullptr || !same_fractal(field_->scene(), scene)) {
        Scene conservative = scene;
        conservative.conservative = true;
        field_ = std::make_unique<DistanceField>(conservative, 1);
    }
    return *field_;
}

double Motion::clearance(const Scene& scene) const { return field(scene).distance(scene.eye); }

bool Motion::move(Scene& scene, const MotionInput& wish, double seconds)
{
    const double share = 1 - std::exp(-seconds / inertia);
    way_ = towards(way_, wish.way, share);
    turn_ = towards(turn_, wish.turn, share);
    const Vector angles = {turning * seconds * turn_.x + wish.yaw, turning * seconds * turn_.y + wish.pitch,
                           turning * seconds * turn_.z};
    if (length(way_) == 0 && length(angles) == 0) return false;

    const Camera camera = camera_of(scene);
    Vector forward = camera.forward;
    Vector right = unit(camera.across);
    Vector up = unit(camera.upward);
    if (length(angles) != 0) {
        forward = turned(forward, up, -angles.x);
        right = turned(right, up, -angles.x);
        forward = turned(forward, right, angles.y);
        up = turned(up, right, angles.y);
        up = turned(up, forward, angles.z);
        scene.up = unit(up);
    }
    if (length(way_) != 0) {
        const DistanceField& known = field(scene);
        const double clearance = known.distance(scene.eye);
        const double least = nearest * known.bounds().size;
        Vector step =
            (speed * seconds * std::max(clearance, least)) * (way_.x * right + way_.y * up + way_.z * forward);
        if (collides) {
            const double most = most_of_way * known.safety() * clearance;
            if (clearance > least && length(step) > most) step = (most / length(step)) * step;
            // If the camera touches a wall, only steps away from the wall are allowed.
            if (clearance <= least && known.distance(scene.eye + step) <= clearance) step = {};
        }
        scene.eye = scene.eye + step;
    }
    // The target keeps its distance from the eye.
    scene.target = scene.eye + std::max(length(scene.target - scene.eye), 1e-6) * forward;
    return true;
}

}  // namespace mandelmarch::explore
