// SPDX-License-Identifier: Apache-2.0
// How much memory this process may still take.
#pragma once

#include <cstdint>
#include <string>

namespace mandelmarch {

// Bytes that can be had: the smallest of what the system calls available, what the control groups leave
// (core/base/control_group.h) and what the address space limit (RLIMIT_AS) leaves. `root`: the folder that stands for
// /.
std::uint64_t available_memory(const std::string& root = {});

}  // namespace mandelmarch
