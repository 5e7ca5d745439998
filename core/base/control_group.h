// SPDX-License-Identifier: Apache-2.0
// What the control groups of this process (cgroups of Linux, version 1 or 2; containers and job schedulers make them)
// leave it. `root`: the folder that stands for /, so that tests can make a tree of their own.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace mandelmarch {

inline constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

// Bytes that the group and every group above it leave. The page cache that a group counts as used does not count: the
// kernel takes it back when memory is asked for. no_limit where no group has a limit.
std::uint64_t memory_left_in_groups(const std::string& root = {});

// The least processor time that the group or one above it may take in a second, in seconds: 1.5 is one and a half
// cores. nullopt where there is no such quota.
std::optional<double> processor_quota(const std::string& root = {});

// How often a quota has stopped this process's groups, since they were made.
struct Throttling {
    std::uint64_t periods = 0;    // in which the group was busy
    std::uint64_t throttled = 0;  // of them those in which it was stopped
};

// Of the group that was stopped most often.
Throttling throttling(const std::string& root = {});

}  // namespace mandelmarch
