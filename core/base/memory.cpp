// SPDX-License-Identifier: Apache-2.0
#include "core/base/memory.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace mandelmarch {
namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

// The number after `key` in a file of lines `key number ...`, or `unlimited`.
std::uint64_t value_of(const std::string& path, const std::string& key)
{
    std::ifstream file(path);
    std::string word;
    while (file >> word) {
        std::uint64_t value = 0;
        if (word == key && file >> value) return value;
    }
    return unlimited;
}

// A file that holds one number; `unlimited` where it is missing or says "max".
std::uint64_t number_in(const std::string& path)
{
    std::ifstream file(path);
    std::uint64_t value = 0;
    return file >> value ? value : unlimited;
}

// This process's folder below /sys/fs/cgroup for a controller ("" is version 2), without a trailing slash.
std::string control_group(const std::string& controller)
{
    std::ifstream file("/proc/self/cgroup");
    std::string line;
    while (std::getline(file, line)) {
        const auto first = line.find(':');
        const auto second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        if (line.substr(first + 1, second - first - 1) != controller) continue;
        const std::string path = line.substr(second + 1);
        return path == "/" ? "" : path;
    }
    return "";
}

std::uint64_t left_of(std::uint64_t limit, std::uint64_t used)
{
    if (limit == unlimited) return unlimited;
    return limit - std::min(limit, used == unlimited ? 0 : used);
}

// What the control group and every group above it leave.
std::uint64_t left_in_group(const std::string& root, std::string group, const char* limit, const char* used)
{
    std::uint64_t left = unlimited;
    for (;;) {
        left = std::min(left, left_of(number_in(root + group + limit), number_in(root + group + used)));
        if (group.empty()) return left;
        group.erase(group.rfind('/'));
    }
}

}  // namespace

std::uint64_t available_memory()
{
    constexpr std::uint64_t kibibyte = 1024;
    const std::uint64_t system = value_of("/proc/meminfo", "MemAvailable:");
    std::uint64_t left = system == unlimited ? unlimited : system * kibibyte;
    left = std::min(left, left_in_group("/sys/fs/cgroup", control_group(""), "/memory.max", "/memory.current"));
    left = std::min(left, left_in_group("/sys/fs/cgroup/memory", control_group("memory"), "/memory.limit_in_bytes",
                                        "/memory.usage_in_bytes"));
    rlimit address_space{};
    if (getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY) {
        const std::uint64_t used = value_of("/proc/self/status", "VmSize:");
        left = std::min(left, left_of(address_space.rlim_cur, used == unlimited ? 0 : used * kibibyte));
    }
    return left;
}

}  // namespace mandelmarch
