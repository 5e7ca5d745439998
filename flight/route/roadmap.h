// SPDX-License-Identifier: Apache-2.0
// Roadmaps: the balls and the gates of a shape. A fractal that changes in flight has a set of roadmaps.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <vector>

#include "flight/field/field.h"
#include "flight/route/gates.h"
#include "flight/route/schedule.h"

namespace mandelmarch {

// The roadmap of one shape.
struct Roadmap {
    DistanceField field;
    Balls balls;
    std::vector<Gate> gates;

    // `coarse`: see Balls. `tries`: approximate number of points at which searches for gates start.
    struct Effort {
        int coarse, tries;
    };
    // `neighbour`: the roadmap of a similar shape, or null. Searches for gates also start at its gates.
    Roadmap(const Scene& scene, const Effort& effort, const Roadmap* neighbour, int threads, const Budget* budget);
    // Searches for more gates. Unless `neighbour` is null, searches also start at its gates.
    void find(const Roadmap* neighbour, int tries);
    Roadmap(const Roadmap&) = delete;
    Roadmap& operator=(const Roadmap&) = delete;
};

// A stretch of time in which a tour uses one roadmap. Time is measured as shape time: the frame of the schedule that
// gives the fractal its shape at a point of the tour.
struct RoadmapSpan {
    const Roadmap* roads;
    double until = std::numeric_limits<double>::infinity();  // shape time at the end of the stretch, in frames
    double value = 0;                                        // the roadmap's value of the changing shape parameter
};

// The roadmaps for the tours of a schedule. If the shape does not change, there is one roadmap, else one for each of up
// to 32 values of the shape parameter. From one value to the next, walls move by about half the smallest clearance of a
// roadmap.
class RoadmapSet {
public:
    // `begins`: called before each of several roadmaps with its number, from 1, and that of all; may be empty.
    RoadmapSet(const Shapes& shapes, const Schedule& schedule, const std::function<void(int, int)>& begins = {});

    // Returns the roadmaps for a film of `frames` frames in order of time. A roadmap can occur several times.
    std::vector<RoadmapSpan> stretches(int frames) const;
    std::size_t shapes() const { return roads_.size(); }
    double step() const { return step_; }  // from one value of the shape parameter to the next

    // Throws InputError if a roadmap has no free space inside the fractal's bounds that is connected with the outside
    // or, unless the shape changes, if there are no gates. `scene`: a scene of the shape, for the message.
    void check(const Scene& scene) const;
    // Returns the balls of all roadmaps. gates() returns the gates of all roadmaps, each as the ball around its
    // narrowest point.
    std::vector<Ball> balls() const;
    std::vector<Ball> gates() const;

private:
    bool has_space() const;
    int number_of(double value) const;
    double value_of(int number) const;

    Schedule schedule_;
    double low_ = 0, high_ = 0, step_ = 1;           // smallest and largest value of the shape parameter, and its step
    std::map<int, std::unique_ptr<Roadmap>> roads_;  // keys: number_of(value)
};

}  // namespace mandelmarch
