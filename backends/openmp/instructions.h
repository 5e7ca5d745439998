// SPDX-License-Identifier: Apache-2.0
// Selects the instruction sets for packs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mandelmarch::openmp {

// Returns the instruction sets that this machine supports, as a set of Highway's targets. If the environment variable
// MANDELMARCH_INSTRUCTIONS is set and not empty, returns only the one that it names: SSE4, AVX2, AVX-512 or a name of
// Highway. Throws InputError if this machine has no instruction set of that name.
std::int64_t instructions();

// Returns the usual name of an instruction set for Highway's name: for example, AVX-512 for AVX3.
std::string usual_name(std::string_view highway);

}  // namespace mandelmarch::openmp
