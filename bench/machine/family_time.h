// SPDX-License-Identifier: Apache-2.0
// Processor time of this program and of the processes that it started.
#pragma once

namespace mandelmarch::bench {

// Returns seconds of user and system time of this process and all its descendants since they started. Ended processes
// count once their parent has waited for them.
double process_tree_seconds();

}  // namespace mandelmarch::bench
