// SPDX-License-Identifier: Apache-2.0
// Prepares configurations for timing and verifies their pictures.
#pragma once

#include <optional>

#include "bench/proof.h"
#include "bench/runner.h"

namespace mandelmarch::bench {

// Renders the configuration's picture once and verifies it. Returns nullopt if the configuration cannot be timed;
// one.row then holds the reason.
std::optional<TimedCase> proven(Case& one, Yardsticks& yardsticks);

// Renders the configuration's picture once without verifying it, for later runs of a program whose first run has
// verified it. The caller must compare the fingerprints. Returns nullopt as proven() does.
std::optional<TimedCase> unproven(Case& one);

}  // namespace mandelmarch::bench
