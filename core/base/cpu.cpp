// SPDX-License-Identifier: Apache-2.0
#include "core/base/cpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

#include "core/base/files.h"

namespace mandelmarch {
namespace {

constexpr std::string_view vector_flags[] = {"sse", "ssse", "avx", "fma", "f16c", "amx", "asimd", "sve"};

std::string_view trimmed(std::string_view text)
{
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<int> number(const std::string& text)
{
    int value = 0;
    return std::istringstream(text) >> value ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string Cpu::platform() const
{
    return family && model ? fmt::format("{} (family {} model {})", name, *family, *model) : name;
}

Cpu read_cpuinfo(std::istream& cpuinfo)
{
    std::map<std::string, std::string, std::less<>> values;
    for (std::string line; std::getline(cpuinfo, line) && !line.empty();) {
        const auto colon = std::min(line.find(':'), line.size());
        const std::string_view whole = line;
        values.emplace(trimmed(whole.substr(0, colon)), trimmed(whole.substr(std::min(colon + 1, line.size()))));
    }
    const auto value = [&](std::string_view key) {
        const auto found = values.find(key);
        return found == values.end() ? std::string() : found->second;
    };
    Cpu cpu;
    if (const std::string name = value("model name"); !name.empty()) cpu.name = name;
    if (const std::string vendor = value("vendor_id"); !vendor.empty()) cpu.vendor = vendor;
    cpu.family = number(value("cpu family"));
    cpu.model = number(value("model"));
    cpu.stepping = number(value("stepping"));
    std::istringstream flags(value("flags") + value("Features"));
    for (std::string flag; flags >> flag;) {
        const auto begins = [&](std::string_view prefix) { return flag.starts_with(prefix); };
        if (std::ranges::any_of(vector_flags, begins)) cpu.vectors.push_back(flag);
        cpu.flags.push_back(flag);
    }
    std::ranges::sort(cpu.flags);
    return cpu;
}

std::vector<Cache> read_caches(const std::string& folder)
{
    std::vector<Cache> caches;
    for (int index = 0;; ++index) {
        const auto line = [&](const char* name) {
            return first_line(fmt::format("{}/index{}/{}", folder, index, name));
        };
        const auto level = number(line("level"));
        if (!level) return caches;
        std::istringstream size(line("size"));  // "1024K"
        Cache cache{.level = *level, .type = line("type"), .bytes = 0, .cores = line("shared_cpu_list")};
        char unit = ' ';
        size >> cache.bytes >> unit;
        if (unit == 'K') cache.bytes <<= 10;
        if (unit == 'M') cache.bytes <<= 20;
        caches.push_back(cache);
    }
}

Cpu host_cpu()
{
    std::ifstream file("/proc/cpuinfo");
    return read_cpuinfo(file);
}

std::string cpu_name() { return host_cpu().name; }

std::string cpu_vendor() { return host_cpu().vendor; }

}  // namespace mandelmarch
