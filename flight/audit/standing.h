// SPDX-License-Identifier: Apache-2.0
// Where a camera stands still longest.
#pragma once

#include <cstddef>
#include <span>

#include "core/scene/scene.h"

namespace mandelmarch {

struct Stand {
    std::size_t first = 0;      // the frame
    std::size_t steps = 0;      // frames on end behind it that lie within its radius
    std::size_t distances = 0;  // that were measured: the work
};

// The first of the longest stands: places[first + 1] to places[first + steps] are within radii[first] of places[first].
// Where a camera stands still or goes on, the work grows with the number of places.
Stand longest_stand(std::span<const Vector> places, std::span<const double> radii);

}  // namespace mandelmarch
