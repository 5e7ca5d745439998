// SPDX-License-Identifier: Apache-2.0
#include "bench/machine/family_time.h"

#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace mandelmarch::bench {
namespace {

struct Usage {
    int parent = 0;
    double ticks = 0;
};

// Parses /proc/PID/stat. The name in parentheses may contain any character. After it, the parent is field 4; user and
// system time, of the process and of children waited for, are fields 14 to 17 (proc(5)).
Usage usage_of(const std::filesystem::path& process)
{
    std::ifstream file(process / "stat");
    std::string line;
    std::getline(file, line);
    const auto bracket = line.rfind(')');
    if (bracket == std::string::npos) return {};
    std::istringstream fields(line.substr(bracket + 1));
    Usage usage;
    std::string skipped;
    fields >> skipped >> usage.parent;
    for (int field = 5; field < 14; ++field) fields >> skipped;
    for (int field = 14; field < 18; ++field) {
        double ticks = 0;
        fields >> ticks;
        usage.ticks += ticks;
    }
    return usage;
}

}  // namespace

double process_tree_seconds()
{
    std::map<int, Usage> all;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const std::string name = entry.path().filename().string();
        int id = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), id);
        if (error == std::errc() && end == name.data() + name.size()) all[id] = usage_of(entry.path());
    }
    std::set<int> family{getpid()};
    for (bool grown = true; grown;) {
        grown = false;
        for (const auto& [id, usage] : all) {
            if (family.contains(usage.parent)) grown = family.insert(id).second || grown;
        }
    }
    double ticks = 0;
    for (const int id : family) ticks += all[id].ticks;
    return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

}  // namespace mandelmarch::bench
