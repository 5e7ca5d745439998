// SPDX-License-Identifier: Apache-2.0
#include "core/os/memory.h"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "core/os/control_group.h"
#include "core/os/descriptor.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

// Reads a file with lines of the form `key number kB`. Returns the number after `key` in bytes; no_limit if the key is
// absent.
std::uint64_t bytes_after(const std::string& path, const std::string& key)
{
    constexpr std::uint64_t kibibyte = 1024;
    std::ifstream file(path);
    std::string word;
    while (file >> word) {
        std::uint64_t value = 0;
        if (word == key && file >> value) return value * kibibyte;
    }
    return no_limit;
}

}  // namespace

std::uint64_t available_memory(const std::string& root)
{
    std::uint64_t left = std::min(bytes_after(root + "/proc/meminfo", "MemAvailable:"), memory_left_in_groups(root));
    rlimit address_space{};
    if (getrlimit(RLIMIT_AS, &address_space) == 0 && address_space.rlim_cur != RLIM_INFINITY) {
        const std::uint64_t used = bytes_after("/proc/self/status", "VmSize:");
        const std::uint64_t limit = address_space.rlim_cur;
        left = std::min(left, limit - std::min(limit, used == no_limit ? 0 : used));
    }
    return left;
}

std::string memory_shortage(const std::string& what, std::uint64_t needed)
{
    const std::uint64_t available = available_memory();
    if (needed <= available) return "";
    return fmt::format("{} need {} MiB of memory and {} MiB are available", what, needed >> 20, available >> 20);
}

void refuse_shortage(const std::string& doing)
{
    constexpr std::uint64_t large_driver = 256 << 20;  // bytes
    std::string why = memory_shortage("drivers", large_driver);
    {
        std::array<Descriptor, 16> spare;
        for (Descriptor& one : spare) {
            one = Descriptor(eventfd(0, EFD_CLOEXEC));
            if (one.number() < 0) why = std::strerror(errno);
        }
    }
    if (!why.empty()) throw Error(fmt::format("{}: {}", doing, why));
}

}  // namespace mandelmarch
