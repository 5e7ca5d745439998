// SPDX-License-Identifier: Apache-2.0
// Declares the fractals' descriptors. core/scene/fractals/NAME.cpp defines descriptors::NAME. The build generates the
// list of names.
#pragma once

#include "core/scene/formula.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
using namespace formula;  // used by the descriptors' templates
}

namespace mandelmarch::descriptors {

#define MM_FRACTAL(name) extern const Fractal name;
#include "fractals.inc"
#undef MM_FRACTAL

}  // namespace mandelmarch::descriptors
