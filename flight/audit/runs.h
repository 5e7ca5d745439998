// SPDX-License-Identifier: Apache-2.0
// The shapes that a path's frames have, one after another.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "flight/field/field.h"
#include "flight/path/path.h"

namespace mandelmarch {

// Frames that have the same fractal constants one after another, with their field. Where the fractal changes in flight
// a run is a frame.
struct Run {
    std::size_t first, last;  // [first, last)
    std::unique_ptr<Field> field;
};

class Runs {
public:
    // `threads`: 0 for one a core.
    Runs(const Path& path, int threads);

    std::span<const Run> all() const { return runs_; }
    bool changes() const { return runs_.size() > 1; }
    const Field& field(std::size_t frame) const { return *runs_[of_[frame]].field; }
    // True where the frame's shape is not that of the frame before.
    bool changed(std::size_t frame) const { return frame > 0 && of_[frame] != of_[frame - 1]; }
    int threads() const { return runs_.front().field->threads(); }

    // The estimate at each frame's eye.
    std::vector<double> clearances() const;

    // True where nothing solid is met on the way from the frame before: straight, in the shapes of both, and while
    // place and shape go from one to the other together.
    bool free_before(std::size_t frame, std::span<const double> clearances) const;

    // By how much the change of shape alone changes the estimate at the frame's eye since the frame before, over the
    // lesser of the two.
    double wall_step(std::size_t frame, std::span<const double> clearances) const;

private:
    struct Moment {
        Scene scene;
        double clearance;
    };
    static bool free_between(const Moment& from, const Moment& to, double floor, int depth);

    const Path& path_;
    std::vector<Run> runs_;
    std::vector<std::size_t> of_;  // of each frame: its run
};

}  // namespace mandelmarch
