// SPDX-License-Identifier: Apache-2.0
// Runs a whole study: plan, verification, counting, peaks, timed rounds.
#pragma once

#include "bench/measure/runner.h"

namespace mandelmarch::bench {

// Runs the study that the options name. All pictures are verified before anything is timed; a configuration with a
// wrong picture is not timed. Throws InputError if the options select no configuration. If a single backend is
// selected, throws Unavailable if it is not available, and Error if it fails to list its devices.
Result measure(const Registry& registry, const Options& options, const Phase& phase);

}  // namespace mandelmarch::bench
