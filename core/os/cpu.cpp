// SPDX-License-Identifier: Apache-2.0
#include "core/os/cpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>

#include "core/os/files.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

constexpr std::string_view vector_flags[] = {"sse", "ssse", "avx", "fma", "f16c", "amx", "asimd", "sve"};

// Names of ARM processors, for which Linux gives only numbers: the registers MIDR_EL1.Implementer and PartNum.
struct ArmName {
    std::string_view implementer, part, name;
};

constexpr ArmName arm_names[] = {
    {"0x41", "0xd03", "ARM Cortex-A53"},  {"0x41", "0xd08", "ARM Cortex-A72"},  {"0x41", "0xd0b", "ARM Cortex-A76"},
    {"0x41", "0xd0c", "ARM Neoverse N1"}, {"0x41", "0xd40", "ARM Neoverse V1"}, {"0x41", "0xd49", "ARM Neoverse N2"},
    {"0x41", "0xd4f", "ARM Neoverse V2"}, {"0x46", "0x001", "Fujitsu A64FX"},   {"0xc0", "0xac3", "Ampere Ampere-1"},
};

// Returns a name such as "ARM Neoverse N1", or the numbers if they are not in the table.
std::string arm_name(std::string_view implementer, std::string_view part)
{
    for (const ArmName& known : arm_names) {
        if (known.implementer == implementer && known.part == part) return std::string(known.name);
    }
    return fmt::format("ARM implementer {} part {}", implementer, part);
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
    if (const std::string vendor = value("CPU implementer"); !vendor.empty()) {
        cpu.name = arm_name(vendor, value("CPU part"));
        cpu.vendor = cpu.name.substr(0, cpu.name.find(' '));
    }
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
    // Read once, because renderers report the processor with every picture.
    static const Cpu cpu = [] {
        std::ifstream file("/proc/cpuinfo");
        return read_cpuinfo(file);
    }();
    return cpu;
}

std::string cpu_name() { return host_cpu().name; }

std::string cpu_vendor() { return host_cpu().vendor; }

}  // namespace mandelmarch
