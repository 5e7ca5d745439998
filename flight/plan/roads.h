// SPDX-License-Identifier: Apache-2.0
// Roads: the balls and gates of a shape, and of all shapes that a changing fractal has in flight.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "flight/field/shapes.h"
#include "flight/plan/gates.h"
#include "flight/plan/schedule.h"

namespace mandelmarch {

// Distances count in clearances, as that is how the camera's speed goes: the integral of ds / min(clearance, cap).
// 0.1 hull sizes: beyond it a wider space is flown through no faster.
double fastest_clearance(const Hull& hull);

// The roads of one shape.
struct Roads {
    Field field;
    Balls balls;
    std::vector<Gate> gates;

    // Cells of the balls' coarse grid along an edge; places where gates are looked for.
    struct Effort {
        int coarse, tries;
    };
    // Gates are looked for where `neighbour`, the roads of a shape that is nearly the same, has some, too; or null.
    Roads(const Scene& scene, const Effort& effort, const Roads* neighbour, int threads, const Budget* budget);
    // Looks for more gates, where `neighbour` has some, too.
    void find(const Roads* neighbour, int tries);
    Roads(const Roads&) = delete;
    Roads& operator=(const Roads&) = delete;
};

// The roads that are flown until the clock passes `until`.
struct Stretch {
    const Roads* roads;
    double until = std::numeric_limits<double>::infinity();  // frames
    double value = 0;                                        // of the shape number that changes
};

// The roads that tours of a schedule are sought on: one shape's where nothing changes, else those of values so near to
// each other that walls move by about half a road's least clearance from one to the next.
class Atlas {
public:
    Atlas(const Shapes& shapes, const Schedule& schedule);

    // In their order, for a film of so many frames.
    std::vector<Stretch> stretches(int frames) const;
    std::size_t shapes() const { return roads_.size(); }
    double step() const { return step_; }  // from one value to the next

    // True if every shape's roads have balls inside the fractal's hull that are connected to the outside.
    bool has_space() const;
    // Of all roads; a gate as its narrowest place.
    std::vector<Ball> balls() const;
    std::vector<Ball> gates() const;

private:
    int number_of(double value) const;
    double value_of(int number) const;

    Schedule schedule_;
    double low_ = 0, high_ = 0, step_ = 1;         // of the values
    std::map<int, std::unique_ptr<Roads>> roads_;  // by the number of their value
};

}  // namespace mandelmarch
