// SPDX-License-Identifier: Apache-2.0
// Rows before they are timed: made ready, and their pictures proven.
#pragma once

#include <optional>

#include "bench/proof.h"
#include "bench/runner.h"

namespace mandelmarch::bench {

// Draws the row's picture once and compares it. What comes back can be timed; where nothing does, the row says why.
std::optional<Live> proven(Case& one, Yardsticks& yardsticks);

// The same without a comparison, for a further process of a program that has proven the picture: whoever asks compares
// the fingerprints.
std::optional<Live> unproven(Case& one);

}  // namespace mandelmarch::bench
