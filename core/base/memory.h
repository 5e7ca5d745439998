// SPDX-License-Identifier: Apache-2.0
// How much memory this process may still take.
#pragma once

#include <cstdint>
#include <string>

namespace mandelmarch {

// Bytes that this process can still allocate: the smallest of the system's available memory, the memory left by the
// control groups (core/base/control_group.h), and the address space left by RLIMIT_AS. `root`: the folder that stands
// for /.
std::uint64_t available_memory(const std::string& root = {});

}  // namespace mandelmarch
