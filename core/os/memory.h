// SPDX-License-Identifier: Apache-2.0
// Memory and descriptors available to this process.
#pragma once

#include <cstdint>
#include <string>

namespace mandelmarch {

// Returns the bytes that this process can still allocate: the min of the system's available memory, the memory left by
// the control groups (core/os/control_group.h), and the address space left by RLIMIT_AS. `root` is the folder to use
// in place of /, so that tests can supply files.
std::uint64_t available_memory(const std::string& root = {});

// Returns "`what` need N MiB of memory and M MiB are available" if `needed` bytes are not available, else "".
std::string memory_shortage(const std::string& what, std::uint64_t needed);

// Throws Error if this process can open only few further files or get only little further memory. A driver that is
// installed then seems to be missing. The message begins with `doing`.
void refuse_shortage(const std::string& doing);

}  // namespace mandelmarch
