// SPDX-License-Identifier: Apache-2.0
// Finds variants, and selects the instruction sets for packs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "backends/openmp/variant.h"
#include "core/render/backend.h"

namespace mandelmarch::openmp {

// Returns the instruction sets that this machine supports, as a set of Highway's targets. If the environment variable
// MANDELMARCH_INSTRUCTIONS is set and not empty, returns only the one that it names: SSE4, AVX2, AVX-512 or a name of
// Highway. Throws InputError if this machine has no instruction set of that name.
std::int64_t instructions();

// Returns the usual name of an instruction set for Highway's name: for example, AVX-512 for AVX3.
std::string usual_name(std::string_view highway);

// Functions that find a definition by its variant_name(): scalar_variant() the scalar variant (scalar.cpp.in),
// pack_variants() the function that lists the variants in packs (packs.cpp.in). They return nullptr if the name is
// unknown. cmake/Kernels.cmake generates them.
template <class Real>
const Variant<Real>* scalar_variant(std::string_view name);
template <class Real>
using PackVariants = VariantList<Real>(std::int64_t targets);
template <class Real>
PackVariants<Real>* pack_variants(std::string_view name);

// Returns a fractal's variants for some instruction sets. The first is scalar; the best one is last.
template <class Real>
std::vector<Variant<Real>> variants_of(std::string_view fractal, Mode mode, std::int64_t targets = instructions());

}  // namespace mandelmarch::openmp
