// SPDX-License-Identifier: Apache-2.0
// Smooths a rough way inside the free space.
#pragma once

#include "flight/plan/tour.h"

namespace mandelmarch {

// An elastic band of points at distances of about a third of their clearance: it is drawn straight and away from walls,
// while each point stays in a ball around its place and the pins stay where they are. `least`: no point goes where the
// distance estimate is less.
std::vector<Vector> smooth(const Field& field, const Way& way, double least);

}  // namespace mandelmarch
