// SPDX-License-Identifier: Apache-2.0
// A warning about a view that shows nothing, or a wrong picture.
#pragma once

#include <string>

#include "core/render/backend.h"

namespace mandelmarch::explore {

// A warning for the user; empty if all is well. `clearance`: the distance estimate at the eye. `one_colour`: the
// picture of the camera at rest has a single colour.
std::string word_on(const Scene& scene, double clearance, Precision precision, bool one_colour);

}  // namespace mandelmarch::explore
