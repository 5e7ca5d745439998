// SPDX-License-Identifier: Apache-2.0
// The audit's items about views: motion, dullness and repetition.
#pragma once

#include <span>

#include "flight/audit/audit.h"
#include "flight/audit/views.h"

namespace mandelmarch {

// Views of some frames: `views[i]` belongs to frame `frames[i]`.
struct Seen {
    int frames_per_second;
    std::vector<std::size_t> frames;
    std::vector<DepthView> views;
};

Row motion_row(const Path& path, const Seen& seen);

// Returns the percentage of dull frames, and the longest time during which all frames are dull. `clearances`: one for
// each frame of the path; `stride`: frames from one view to the next.
std::vector<Row> dull_rows(const Seen& seen, std::span<const double> clearances, std::size_t stride);

// Returns the percentage of frames that mostly show the background, and the longest time in which the fractal is only
// at the picture's edge.
std::vector<Row> subject_rows(const Seen& seen, std::size_t stride);

// Returns the number of views that are seen again within a minute, after a different view in between.
Row again_row(const Seen& seen);

// Returns "frame 12".
std::string at_frame(std::size_t frame);

}  // namespace mandelmarch
