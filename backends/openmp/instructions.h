// SPDX-License-Identifier: Apache-2.0
// Instruction sets for packs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mandelmarch::openmp {

// Returns the instruction sets of this machine, as a set of Highway's targets. MANDELMARCH_INSTRUCTIONS in the
// environment selects one of them: SSE4, AVX2 or AVX-512, or a name of Highway; empty counts as not set. Throws
// InputError.
std::int64_t instructions();

// Returns the maker's name of an instruction set; Highway calls AVX-512 AVX3.
std::string usual_name(std::string_view highway);

}  // namespace mandelmarch::openmp
