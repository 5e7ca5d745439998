// SPDX-License-Identifier: Apache-2.0
// Prepares configurations for timing and verifies their pictures.
#pragma once

#include <optional>

#include "bench/proof.h"
#include "bench/runner.h"

namespace mandelmarch::bench {

// Renders the configuration's picture once and verifies it. Returns nullopt if it cannot be timed; its row says why.
std::optional<TimedCase> proven(Case& one, Yardsticks& yardsticks);

// The same without verification, for further processes of a program that has verified the picture. The caller compares
// fingerprints.
std::optional<TimedCase> unproven(Case& one);

}  // namespace mandelmarch::bench
