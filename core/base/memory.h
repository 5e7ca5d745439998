// SPDX-License-Identifier: Apache-2.0
// How much memory this process may still take.
#pragma once

#include <cstdint>

namespace mandelmarch {

// Bytes that can be had: the smallest of what the system calls available, what the control group leaves (version 2 or
// 1) and what the address space limit (RLIMIT_AS) leaves.
std::uint64_t available_memory();

}  // namespace mandelmarch
