// SPDX-License-Identifier: Apache-2.0
// Processor time of this program and of the processes that it has started.
#pragma once

namespace mandelmarch::bench {

// Seconds of user and system time since they began: of this process, its children, and theirs, ended ones included
// where their parent has waited for them.
double family_seconds();

}  // namespace mandelmarch::bench
