// SPDX-License-Identifier: Apache-2.0
// The longest time for which a camera stands still.
#pragma once

#include <cstddef>
#include <span>

#include "core/scene/scene.h"

namespace mandelmarch {

struct Stand {
    std::size_t first = 0;      // the frame
    std::size_t steps = 0;      // consecutive frames after it that lie within its radius
    std::size_t distances = 0;  // number of distances computed
};

// Returns the longest stand, the first of several: places[first + 1] to places[first + steps] are within radii[first]
// of places[first]. Takes time proportional to the number of places for a camera that stands still or moves steadily.
Stand longest_stand(std::span<const Vector> places, std::span<const double> radii);

}  // namespace mandelmarch
