// SPDX-License-Identifier: Apache-2.0
// The successive shapes of a path, each with its frames and its distance field.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "flight/field/field.h"
#include "flight/path/path.h"

namespace mandelmarch {

// The estimate, in fractal sizes, up to which a point counts as solid.
inline constexpr double in_solid = 1e-5;

// Consecutive frames whose shape, iterations and escape radius are the same, and their distance field.
struct Run {
    std::size_t first, last;  // frames [first, last)
    std::unique_ptr<DistanceField> field;
};

class Runs {
public:
    // `threads`: 0 for as many as the process may use.
    Runs(const Path& path, int threads);

    bool changes() const { return runs_.size() > 1; }
    const DistanceField& field(std::size_t frame) const { return *runs_[of_[frame]].field; }
    // Returns true if the frame belongs to another run than the previous frame.
    bool changed(std::size_t frame) const { return frame > 0 && of_[frame] != of_[frame - 1]; }
    int threads() const { return runs_.front().field->threads(); }

    // Returns the estimate at each frame's eye.
    std::vector<double> clearances() const;

    // Returns true if the camera meets no solid on its way from the previous frame to this one. The straight segment is
    // tested in the shapes of both frames. If the shapes differ, moments in between are tested as well, with position
    // and shape interpolated linearly. `clearances`: the estimates at all frames' eyes.
    bool free_before(std::size_t frame, std::span<const double> clearances) const;

    // Returns the difference of two estimates at the frame's eye, divided by the smaller of the two: one for the shape
    // of the previous frame, and one for the shape of this frame.
    double wall_step(std::size_t frame, std::span<const double> clearances) const;

private:
    struct Moment {
        Scene scene;
        double clearance;
    };
    // Returns true if the estimate is above `floor` halfway between the moments and, by recursion, halfway in both
    // halves. The recursion ends when the estimate halfway is close to the mean of the estimates at the two ends, or
    // when it has reached the greatest depth.
    static bool free_between(const Moment& from, const Moment& to, double floor, int depth);

    const Path& path_;
    std::vector<Run> runs_;
    std::vector<std::size_t> of_;  // for each frame: its run's index
};

}  // namespace mandelmarch
