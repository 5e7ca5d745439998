// SPDX-License-Identifier: Apache-2.0
// The distance field of one scene for planning and auditing, in double precision and in parallel. Results are
// bit-identical on any number of threads.
#pragma once

#include <span>
#include <vector>

#include "core/render/kernel_scene.h"
#include "core/scene/scene.h"
#include "flight/field/budget.h"
#include "flight/field/hull.h"
#include "flight/field/kernel.h"

namespace mandelmarch {

class DistanceField {
public:
    // `threads`: 0 for all that the process may use. `budget`, if not null, must outlive the field; it is checked in
    // computations of many distances. Throws Unavailable if the fractal was not built.
    DistanceField(const Scene& scene, int threads, const Budget* budget = nullptr);

    const Scene& scene() const { return scene_; }
    const Bounds& bounds() const { return bounds_; }
    int threads() const { return threads_; }
    const Budget* budget() const { return budget_; }

    // The fraction of a distance estimate that is certainly free space.
    double safety() const { return safety_; }

    // Returns the same point for all points that the fractal's symmetry maps onto each other.
    Vector representative(Vector p) const { return scene_.fractal->flight.representative(scene_, p); }

    // True in a region that holds, for every point, an equivalent one under the fractal's symmetry.
    bool worth_searching(Vector p) const { return scene_.fractal->flight.worth_searching(scene_, bounds_, p); }

    // Returns the distance estimate at p, in the scene's units; 0 if it is negative or NaN.
    double distance(Vector p) const;
    void distances(std::span<const Vector> points, std::span<double> out) const;

    // Writes t at the end of each ray to `out`. `along`: unit vectors.
    void casts(std::span<const Vector> from, std::span<const Vector> along, const field::Reach& reach,
               std::span<double> out) const;

    // Returns the unit gradient of the distance by central differences of step h, or a zero vector if all are zero.
    Vector uphill(Vector p, double h) const;

    // Returns the smallest estimate on the segment from a to b, sampled so densely that the samples' safe balls
    // overlap. Stops at the first estimate that is not above `floor`.
    double least_between(Vector a, Vector b, double floor) const;

private:
    Scene scene_;
    field::Kernel kernel_;
    layout_f64::Scene data_;
    double safety_;
    int threads_;
    const Budget* budget_;
    Bounds bounds_;
};

}  // namespace mandelmarch
