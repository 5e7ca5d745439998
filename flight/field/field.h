// SPDX-License-Identifier: Apache-2.0
// Distance fields for planning and auditing, in double precision and in parallel. Results are bit-identical on any
// number of threads.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "core/scene/scene.h"
#include "flight/field/kernel.h"

namespace mandelmarch {

// A time limit for searches, so that every search ends.
class Budget {
public:
    // `seconds`: limit on the processor time of all threads of the program, measured from the construction. Other load
    // on the machine therefore does not shorten a search. `expected`: what helps, for the message.
    Budget(double seconds, std::string expected);

    // Throws InputError if the time is used up.
    void check() const;

private:
    double seconds_, start_;
    std::string expected_;
};

class DistanceField {
public:
    // `threads`: 0 for as many as the process may use. `budget`, if not null, must outlive the field; computations of
    // more than 256 distances or rays check it. Throws Unavailable if this build does not contain the fractal.
    DistanceField(const Scene& scene, int threads, const Budget* budget = nullptr);

    const Scene& scene() const { return scene_; }
    // The bounds that the fractal's descriptor gives, or else a sphere found by casting rays from far outside. If a
    // length is given in "fractal sizes", the unit is the size of these bounds.
    const Bounds& bounds() const { return bounds_; }
    int threads() const { return threads_; }
    const Budget* budget() const { return budget_; }

    // Returns the safe fraction of a distance estimate. A ball around a point is free space if its radius is this
    // fraction of the estimate at the point.
    double safety() const { return safety_; }

    // Returns a point that is equivalent to p under the fractal's symmetry. The result is the same for all equivalent
    // points.
    Vector representative(Vector p) const { return scene_.fractal->flight.representative(scene_, p); }

    // Returns true if p lies in the region to be searched. That region contains, for every point in space, an
    // equivalent point under the fractal's symmetry.
    bool worth_searching(Vector p) const { return scene_.fractal->flight.worth_searching(scene_, bounds_, p); }

    // Returns the distance estimate at p, in the scene's units; 0 if it is negative or NaN.
    double distance(Vector p) const;
    void distances(std::span<const Vector> points, std::span<double> out) const;

    // Marches rays and writes the length of each to `out`. `from`: their origins; `along`: their directions, which are
    // unit vectors; `reach`: the conditions under which they end.
    void casts(std::span<const Vector> from, std::span<const Vector> along, const field::Reach& reach,
               std::span<double> out) const;

    // Returns the direction in which the distance grows fastest, as a unit vector. It is the gradient by central
    // differences with step h; a zero vector if the gradient is zero.
    Vector uphill(Vector p, double h) const;

    // Returns the smallest of the estimates at samples on the segment from a to b. Each sample lies in the safe ball of
    // the one before it. Stops at the first estimate that is not above `floor`.
    double least_between(Vector a, Vector b, double floor) const;

private:
    layout_f64::Scene data_;
    Scene scene_;
    field::Kernel kernel_;
    Bounds bounds_;
    const Budget* budget_;
    double safety_;
    int threads_;
};

// Returns a message of one line that says why the scene's fractal cannot be flown through and which input is expected;
// empty if it can be flown through. Only the scene's shape matters; distances are not computed.
std::string flight_objection(const Scene& scene);

// Returns the clearance above which the camera does not fly faster: 0.1 fractal sizes. The camera's speed is
// proportional to m = min(clearance, fastest_clearance). The cost of a way is therefore its duration, the integral of
// ds / m. In other words, it is the length of the way in clearances.
inline double fastest_clearance(const Bounds& bounds) { return 0.1 * bounds.size; }

// Distance fields of a fractal for flights during which one shape parameter changes, such as the Mandelbulb's power.
class Shapes {
public:
    // `number`: index in Scene::shape of the parameter that changes. Its value in `scene` is called the usual value.
    Shapes(const Scene& scene, std::size_t number, int threads, const Budget* budget = nullptr);

    // Returns the distance field of the shape with the usual value.
    const DistanceField& field() const { return field_; }
    double usual() const { return field_.scene().shape[number_]; }
    int threads() const { return field_.threads(); }
    const Budget* budget() const { return field_.budget(); }

    Scene scene(double value) const;
    // Returns the distance field of the shape with this value. If the value is not the usual one, the field is built in
    // `room`, and the returned reference is valid until `room` changes or ends.
    const DistanceField& at(double value, std::optional<DistanceField>& room) const;

    // Writes the estimate at each point. `values`: for each point, the parameter's value.
    void distances(std::span<const Vector> points, std::span<const double> values, std::span<double> out) const;

private:
    DistanceField field_;
    std::size_t number_;
};

}  // namespace mandelmarch
