// SPDX-License-Identifier: Apache-2.0
// Identification of the CPU.
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
    std::string cores{};  // cores that share this cache, in Linux's list format: "0-7"
};

struct Cpu {
    std::string name = "CPU";  // as reported by the CPU, or by its numbers on ARM; "CPU" if unknown
    std::string vendor = "unknown";
    // Numbers that identify the design of an x86 CPU; different designs can have the same name. nullopt if unknown.
    std::optional<int> family, model, stepping;
    std::vector<std::string> flags;    // Linux's names, sorted
    std::vector<std::string> vectors;  // the vector extensions among the flags, in Linux's order

    // Returns the name with family and model, as in "AMD EPYC (family 25 model 17)". CPUs of different designs have
    // different results. If family or model is unknown, returns the name alone.
    std::string platform() const;
};

// Parses the text of /proc/cpuinfo. Only its first processor is used.
Cpu read_cpuinfo(std::istream& cpuinfo);

// Reads the caches of a core from a folder such as /sys/devices/system/cpu/cpu0/cache. Returns an empty list if the
// folder does not exist.
std::vector<Cache> read_caches(const std::string& folder);

Cpu host_cpu();
std::string cpu_name();  // host_cpu().name
std::string cpu_vendor();

}  // namespace mandelmarch
