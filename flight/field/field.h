// SPDX-License-Identifier: Apache-2.0
// Distances of one scene for planning and auditing, in double, on all cores. The same bits on any number of threads.
#pragma once

#include <span>
#include <vector>

#include "core/render/kernel_scene.h"
#include "core/scene/scene.h"
#include "flight/field/budget.h"
#include "flight/field/hull.h"
#include "flight/field/kernel.h"

namespace mandelmarch {

class Field {
public:
    // `threads`: 0 for all that the process may use. `budget`, if not null, must outlive the field; it is checked while
    // many distances are computed. Throws Unavailable for a fractal that is not built.
    Field(const Scene& scene, int threads, const Budget* budget = nullptr);

    const Scene& scene() const { return scene_; }
    const Hull& hull() const { return hull_; }
    int threads() const { return threads_; }
    const Budget* budget() const { return budget_; }

    // The share of an estimate that is surely free.
    double safety() const { return safety_; }

    // Places that the fractal's symmetry maps onto each other get the same answer.
    Vector representative(Vector p) const { return scene_.fractal->flight.representative(scene_, p); }

    // True in a region that holds a copy of every place that differs under the symmetry.
    bool worth_searching(Vector p) const { return scene_.fractal->flight.worth_searching(scene_, hull_, p); }

    // The distance estimate at p, in the scene's units; 0 where it is negative or no number.
    double distance(Vector p) const;
    void distances(std::span<const Vector> points, std::span<double> out) const;

    // t at the end of each ray.
    void casts(std::span<const Vector> from, std::span<const Vector> along, const field::Reach& reach,
               std::span<double> out) const;

    // The direction in which the distance grows most, by differences of step h; zero where it does not change.
    Vector uphill(Vector p, double h) const;

    // The least estimate on the way from a to b, sampled so densely that the samples' safe balls overlap; stops at
    // `floor` and returns what it found there.
    double least_between(Vector a, Vector b, double floor) const;

private:
    Scene scene_;
    field::Kernel kernel_;
    layout_f64::Scene data_;
    double safety_;
    int threads_;
    const Budget* budget_;
    Hull hull_;
};

}  // namespace mandelmarch
