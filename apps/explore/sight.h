// SPDX-License-Identifier: Apache-2.0
// A word on a view that shows nothing, or not what it should.
#pragma once

#include <string>

#include "core/render/backend.h"

namespace mandelmarch::explore {

// For the user, or nothing where all is well. `clearance`: the distance estimate at the eye. `one_colour`: all of the
// picture at rest has one colour.
std::string word_on(const Scene& scene, double clearance, Precision precision, bool one_colour);

}  // namespace mandelmarch::explore
