// SPDX-License-Identifier: Apache-2.0
// Warnings about views whose picture is empty or wrong.
#pragma once

#include <string>

#include "core/render/backend.h"

namespace mandelmarch::explore {

// Returns a warning for the user, or "". `clearance`: the distance estimate at the eye. `one_colour`: the view's
// picture at rest is complete and has a single colour.
std::string word_on(const Scene& scene, double clearance, Precision precision, bool one_colour);

}  // namespace mandelmarch::explore
