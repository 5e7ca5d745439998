// SPDX-License-Identifier: Apache-2.0
#include "core/os/control_group.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "core/text/text.h"

namespace mandelmarch {
namespace {

using Numbers = std::map<std::string, std::uint64_t, std::less<>>;

// Reads the lines of the form `key number` of a file.
Numbers numbers_in(const std::string& path)
{
    std::ifstream file(path);
    Numbers found;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string key;
        std::uint64_t value = 0;
        if (words >> key >> value) found.emplace(key, value);
    }
    return found;
}

std::uint64_t value_of(const Numbers& numbers, std::string_view key)
{
    const auto found = numbers.find(key);
    return found == numbers.end() ? 0 : found->second;
}

// Returns the number in a file; no_limit if the file is missing or contains "max".
std::uint64_t number_in(const std::string& path)
{
    std::ifstream file(path);
    std::uint64_t value = 0;
    return file >> value ? value : no_limit;
}

// Returns the path of the process's group for a controller of cgroups version 1. If `controller` is empty, returns the
// path of its group in cgroups version 2.
std::string group_of(const std::string& root, std::string_view controller)
{
    std::ifstream file(root + "/proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {  // number:controller,controller:path
        const auto first = line.find(':');
        const auto second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool here =
            controller.empty() ? controllers.empty() : std::ranges::count(split(controllers, ','), controller) > 0;
        if (here) return line.substr(second + 1);
    }
    return {};
}

// Returns the folders of the process's group and of its parent groups; the root group is last. In a container, the root
// group may be the process's own group.
std::vector<std::string> folders(const std::string& root, std::string_view controller)
{
    const std::string groups = root + "/sys/fs/cgroup";
    std::string top = controller.empty() ? groups : groups + "/" + std::string(controller);
    std::error_code none;
    if (controller == "cpu" && !std::filesystem::exists(top, none)) top = groups + "/cpu,cpuacct";
    std::vector<std::string> found;
    for (std::string group = group_of(root, controller); !group.empty() && group != "/";) {
        found.push_back(top + group);
        group.erase(group.rfind('/'));
    }
    found.push_back(top);
    return found;
}

std::uint64_t left_of(std::uint64_t limit, std::uint64_t used, std::uint64_t reclaimable)
{
    if (limit == no_limit || used == no_limit) return limit;
    return limit - std::min(limit, used - std::min(used, reclaimable));
}

std::optional<double> quota_in(const std::string& folder)
{
    double quota = -1;
    double period = 0;
    std::ifstream both(folder + "/cpu.max");  // "50000 100000", "max 100000"
    if (!(both >> quota >> period)) {
        std::ifstream(folder + "/cpu.cfs_quota_us") >> quota;
        std::ifstream(folder + "/cpu.cfs_period_us") >> period;
    }
    return quota > 0 && period > 0 ? std::optional(quota / period) : std::nullopt;
}

}  // namespace

std::uint64_t memory_left_in_groups(const std::string& root)
{
    std::uint64_t left = no_limit;
    for (const std::string& folder : folders(root, "")) {
        const Numbers stat = numbers_in(folder + "/memory.stat");
        const std::uint64_t cache =
            value_of(stat, "inactive_file") + value_of(stat, "active_file") + value_of(stat, "slab_reclaimable");
        const std::uint64_t limit = std::min(number_in(folder + "/memory.max"), number_in(folder + "/memory.high"));
        left = std::min(left, left_of(limit, number_in(folder + "/memory.current"), cache));
    }
    for (const std::string& folder : folders(root, "memory")) {
        const Numbers stat = numbers_in(folder + "/memory.stat");
        const std::uint64_t cache = value_of(stat, "total_inactive_file") + value_of(stat, "total_active_file");
        left = std::min(left, left_of(number_in(folder + "/memory.limit_in_bytes"),
                                      number_in(folder + "/memory.usage_in_bytes"), cache));
    }
    return left;
}

std::optional<double> processor_quota(const std::string& root)
{
    std::optional<double> least;
    for (const char* controller : {"", "cpu"}) {
        for (const std::string& folder : folders(root, controller)) {
            const auto quota = quota_in(folder);
            if (quota && (!least || *quota < *least)) least = quota;
        }
    }
    return least;
}

Throttling throttling(const std::string& root)
{
    Throttling most;
    for (const char* controller : {"", "cpu"}) {
        for (const std::string& folder : folders(root, controller)) {
            const Numbers stat = numbers_in(folder + "/cpu.stat");
            const Throttling here{value_of(stat, "nr_periods"), value_of(stat, "nr_throttled")};
            if (here.throttled >= most.throttled) most = here;
        }
    }
    return most;
}

}  // namespace mandelmarch
