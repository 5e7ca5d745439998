// SPDX-License-Identifier: Apache-2.0
// The audit's rows about what is seen: how it moves, where it is dull, where it comes again.
#pragma once

#include <span>

#include "flight/audit/audit.h"
#include "flight/audit/views.h"

namespace mandelmarch {

// Views of some frames: `frames[i]` is the number of the frame that `views[i]` is of.
struct Seen {
    int frames_per_second;
    std::vector<std::size_t> frames;
    std::vector<Glimpse> views;
};

Row motion_row(const Path& path, const Seen& seen);

// The share of dull frames, and the longest time of them on end. `clearances`: of every frame of the path; `stride`:
// frames between views.
std::vector<Row> dull_rows(const Seen& seen, std::span<const double> clearances, std::size_t stride);

// The share of frames with little to see, and the longest time with it at the picture's edge only.
std::vector<Row> subject_rows(const Seen& seen, std::size_t stride);

Row again_row(const Seen& seen);

// "frame 12"
std::string at_frame(std::size_t frame);

}  // namespace mandelmarch
