// SPDX-License-Identifier: Apache-2.0
// Roadmaps: the balls and gates of one shape, and the set of roadmaps of a fractal that changes in flight.
#pragma once

#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "flight/field/shapes.h"
#include "flight/plan/gates.h"
#include "flight/plan/schedule.h"

namespace mandelmarch {

// The roadmap of one shape.
struct Roadmap {
    DistanceField field;
    Balls balls;
    std::vector<Gate> gates;

    // `coarse`: cells of the balls' coarse grid along an edge. `tries`: points at which a search for gates starts.
    struct Effort {
        int coarse, tries;
    };
    // `neighbour`: the roadmap of a similar shape, at whose gates searches start, too; or null.
    Roadmap(const Scene& scene, const Effort& effort, const Roadmap* neighbour, int threads, const Budget* budget);
    // Searches for more gates, also at those of `neighbour` if it is not null.
    void find(const Roadmap* neighbour, int tries);
    Roadmap(const Roadmap&) = delete;
    Roadmap& operator=(const Roadmap&) = delete;
};

// A roadmap that is used until the shape time passes `until`.
struct RoadmapSpan {
    const Roadmap* roads;
    double until = std::numeric_limits<double>::infinity();  // frames
    double value = 0;                                        // of the changing shape parameter
};

// The roadmaps for tours of a schedule: one if nothing changes, else one for each of many values of the shape
// parameter. From one value to the next, walls move by about half the smallest clearance of a roadmap.
class RoadmapSet {
public:
    RoadmapSet(const Shapes& shapes, const Schedule& schedule);

    // Returns the roadmaps in the order of time, for a film of `frames` frames.
    std::vector<RoadmapSpan> stretches(int frames) const;
    std::size_t shapes() const { return roads_.size(); }
    double step() const { return step_; }  // from one value to the next

    // True if every roadmap has a ball inside the fractal's bounds that is connected with the outside.
    bool has_space() const;
    // Return the balls and gates of all roadmaps; a gate as the ball around its narrowest point.
    std::vector<Ball> balls() const;
    std::vector<Ball> gates() const;

private:
    int number_of(double value) const;
    double value_of(int number) const;

    Schedule schedule_;
    double low_ = 0, high_ = 0, step_ = 1;           // of the values
    std::map<int, std::unique_ptr<Roadmap>> roads_;  // by the index of their value
};

}  // namespace mandelmarch
