// SPDX-License-Identifier: Apache-2.0
// Prepares configurations for timing and verifies their pictures.
#pragma once

#include <optional>

#include "bench/harness/verify.h"
#include "bench/harness/runner.h"

namespace mandelmarch::bench {

// Renders the configuration's picture once and verifies it. Returns nullopt if the configuration cannot be timed;
// one.row then holds the reason.
std::optional<TimedCase> verified_case(Case& one, ExpectedPictures& pictures);

// Renders the configuration's picture once without verifying it, for later runs of a program whose first run has
// verified it. The caller must compare the fingerprints. Returns nullopt as verified_case() does.
std::optional<TimedCase> unverified_case(Case& one);

}  // namespace mandelmarch::bench
