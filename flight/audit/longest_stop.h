// SPDX-License-Identifier: Apache-2.0
// The longest time for which a camera stands still.
#pragma once

#include <cstddef>
#include <span>

#include "core/scene/scene.h"

namespace mandelmarch {

// A stretch of frames in which the camera stays within a radius of its place in the first frame.
struct Stand {
    std::size_t first = 0;      // index of the first frame
    std::size_t steps = 0;      // number of consecutive frames after it that lie within its radius
    std::size_t distances = 0;  // number of distances that the search computed
};

// Returns the longest stand, or the first of several equally long ones. places[first + 1] to places[first + steps] are
// at most radii[first] away from places[first]. If the camera stands still or moves steadily, the time is proportional
// to the number of places.
Stand longest_stand(std::span<const Vector> places, std::span<const double> radii);

}  // namespace mandelmarch
