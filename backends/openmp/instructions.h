// SPDX-License-Identifier: Apache-2.0
// The instruction sets that packs may use.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mandelmarch::openmp {

// Those of this machine, as a set of Highway's targets. MANDELMARCH_INSTRUCTIONS in the environment takes one of them
// alone: SSE4, AVX2 or AVX-512, Highway's names too; empty counts as not set. Throws InputError.
std::int64_t instructions();

// An instruction set by its maker's name; Highway calls AVX-512 AVX3.
std::string usual_name(std::string_view highway);

}  // namespace mandelmarch::openmp
