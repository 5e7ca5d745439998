// SPDX-License-Identifier: Apache-2.0
// Finds variants. variants.cpp is generated from the lists of fractals, precisions and modes.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "backends/openmp/instructions.h"
#include "backends/openmp/variant.h"
#include "core/render/backend.h"

namespace mandelmarch::openmp {

// Returns a fractal's variants for some instruction sets. The first is scalar; the best one is last.
template <class Real>
std::vector<Variant<Real>> variants_of(std::string_view fractal, Mode mode, std::int64_t targets = instructions());

}  // namespace mandelmarch::openmp
