// SPDX-License-Identifier: Apache-2.0
// Resource limits that control groups impose on this process (Linux cgroups, version 1 or 2, set by containers and job
// schedulers). The argument `root` of these functions is the folder to use in place of /, so that tests can supply
// files.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace mandelmarch {

inline constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

// Returns the number of bytes of memory that are left: the min over the process's group and its parent groups; no_limit
// if no group has a limit. Page cache charged to a group counts as free, because the operating system reclaims it on
// demand.
std::uint64_t memory_left_in_groups(const std::string& root = {});

// Returns the min quota of the process's group and its parent groups, in seconds of processor time per second: 1.5
// allows one
// and a half cores. Returns nullopt if there is no quota.
std::optional<double> processor_quota(const std::string& root = {});

// Counts how often a quota has stopped a group since the group was created.
struct Throttling {
    std::uint64_t periods = 0;    // periods in which the group was busy
    std::uint64_t throttled = 0;  // periods in which it was stopped
};

// Returns the counts of the group that was stopped most often, among the process's group and its parent groups.
Throttling throttling(const std::string& root = {});

}  // namespace mandelmarch
