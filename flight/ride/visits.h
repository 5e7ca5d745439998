// SPDX-License-Identifier: Apache-2.0
// Visits: the places of a places file on a tour.
#pragma once

#include <span>
#include <vector>

#include "flight/path/places.h"
#include "flight/route/roadmap.h"
#include "flight/route/tour.h"

namespace mandelmarch {

// Returns the visits of a tour through the roadmap's free space. Their numbers of gates are 0 (see give_gates()).
// `least`: the smallest clearance of a tour; `frames`: those of the film. Throws InputError with the name of the file,
// the line and, if there is one, the nearest alternative in these cases:
// - The second of a place is after the film's end.
// - The camera cannot reach a place.
// - From a place, the picture's middle shows nothing of the fractal.
std::vector<Visit> visits_of(const Places& places, const RoadmapSpan& roads, double least, int frames);

// Sets how many gates lead to each visit. `pace`: the expected speed, in clearances per frame.
void give_gates(std::span<Visit> visits, const Places& places, double pace);

}  // namespace mandelmarch
