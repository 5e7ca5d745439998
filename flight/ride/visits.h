// SPDX-License-Identifier: Apache-2.0
// Visits: the places of a places file on a tour.
#pragma once

#include <span>
#include <vector>

#include "flight/path/places.h"
#include "flight/route/roadmap.h"
#include "flight/route/tour.h"

namespace mandelmarch {

// Throws InputError if no film of `frames` frames can visit the places, whatever its roadmap. The message has the name
// of the file and, for the first places with a fault, the line and the nearest alternative:
// - The second of the place is after the film's end.
// - The place is inside the fractal, or its clearance is less than `least`.
// - From the place, the picture's middle shows nothing of the fractal.
void check_places(const Places& places, const DistanceField& field, double least, int frames);

// Returns the visits of a tour through the roadmap's free space. Their numbers of gates are 0 (see give_gates()).
// `least`: the smallest clearance of a tour. Throws InputError with the name of the file, the line and the nearest
// alternative if the camera cannot reach a place.
std::vector<Visit> visits_of(const Places& places, const RoadmapSpan& roads, double least);

// Sets how many gates lead to each visit. `pace`: the expected speed, in clearances per frame.
void give_gates(std::span<Visit> visits, const Places& places, double pace);

}  // namespace mandelmarch
