// SPDX-License-Identifier: Apache-2.0
// The resources that the control groups of this process leave it (Linux cgroups, version 1 or 2, as containers and job
// schedulers make them). `root`: the folder that stands for /, so that tests can supply a tree of files.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace mandelmarch {

inline constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

// Bytes left in the group and in every group above it; no_limit if no group has a limit. Page cache that a group counts
// as used is free here: the kernel reclaims it when memory is needed.
std::uint64_t memory_left_in_groups(const std::string& root = {});

// The smallest quota of the group and all groups above it, in seconds of processor time per second: 1.5 is one and a
// half cores. nullopt if there is no quota.
std::optional<double> processor_quota(const std::string& root = {});

// Counts of how often a quota has stopped a group since it was made.
struct Throttling {
    std::uint64_t periods = 0;    // periods in which the group was busy
    std::uint64_t throttled = 0;  // periods in which it was stopped
};

// The throttling of the group that was stopped most often.
Throttling throttling(const std::string& root = {});

}  // namespace mandelmarch
