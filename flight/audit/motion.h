// SPDX-License-Identifier: Apache-2.0
// The camera's motion: turns, jerk, roll, passages and standing still.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "flight/audit/audit.h"
#include "flight/field/field.h"

namespace mandelmarch {

// Returns, for each frame, the angle in degrees by which the camera has rotated since the previous frame, including
// roll; 0 for the first frame.
std::vector<double> turns_of(const Path& path);

// Returns the 95th percentiles of the jerk (third differences of the position, in clearances / s^3) and of the angular
// jerk (second differences of the rotation between frames, in degrees / s^3). `clearances`: one per frame.
std::vector<Row> jerk_rows(const Path& path, std::span<const double> clearances);

// Returns the percentage of frames that are within 30 degrees of level. Only frames whose gaze is at least 30 degrees
// from vertical count.
Row level_row(const Path& path);

// A stretch of frames in which the camera stays within a radius of its place in the first frame.
struct Stand {
    std::size_t first = 0;      // index of the first frame
    std::size_t steps = 0;      // number of consecutive frames after the first that lie within the radius
    std::size_t distances = 0;  // number of distances that the search computed
};

// Returns the longest stand, or the first of several equally long ones. places[first + 1] to places[first + steps] are
// at most radii[first] away from places[first]. If the camera stands still or moves steadily, the running time is
// proportional to the number of places.
Stand longest_stand(std::span<const Vector> places, std::span<const double> radii);

}  // namespace mandelmarch
