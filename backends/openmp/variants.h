// SPDX-License-Identifier: Apache-2.0
// Finds variants. variants.cpp is generated from the lists of fractals, precisions and modes.
#pragma once

#include <string_view>
#include <vector>

#include "backends/openmp/variant.h"
#include "core/render/backend.h"

namespace mandelmarch::openmp {

// The variants of a fractal that this machine can run: the scalar one first, the best last.
template <class Real>
std::vector<Variant<Real>> variants_of(std::string_view fractal, Mode mode);

}  // namespace mandelmarch::openmp
