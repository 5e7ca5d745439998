// SPDX-License-Identifier: Apache-2.0
// What CPU this is.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch {

struct Cache {
    int level = 0;
    std::string type;  // "Data", "Instruction" or "Unified"
    std::uint64_t bytes = 0;
    std::string cores{};  // that share it, as Linux lists them: "0-7"
};

struct Cpu {
    std::string name = "CPU";  // as it calls itself, "CPU" where unknown
    std::string vendor = "unknown";
    // Of x86: different designs may share a name. nullopt where unknown.
    std::optional<int> family, model, stepping;
    std::vector<std::string> flags;    // as Linux names them, in the order of the alphabet
    std::vector<std::string> vectors;  // the vector extensions among them, in Linux's order

    // A name that differs where the design does: "AMD EPYC (family 25 model 17)".
    std::string platform() const;
};

// From the text of /proc/cpuinfo, of its first processor.
Cpu read_cpuinfo(std::istream& cpuinfo);

// Those of the first core, from a folder like /sys/devices/system/cpu/cpu0/cache. Empty where it is not there.
std::vector<Cache> read_caches(const std::string& folder);

Cpu host_cpu();
std::string cpu_name();  // host_cpu()'s
std::string cpu_vendor();

}  // namespace mandelmarch
