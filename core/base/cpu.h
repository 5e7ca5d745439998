// SPDX-License-Identifier: Apache-2.0
// What CPU this is.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch {

struct Cpu {
    std::string name = "CPU";  // as it calls itself, "CPU" where unknown
    std::string vendor = "unknown";
    // Of x86: different designs may share a name. nullopt where unknown.
    std::optional<int> family, model, stepping;
    std::vector<std::string> vectors;  // the vector extensions among its flags, as Linux names them

    // A name that differs where the design does: "AMD EPYC (family 25 model 17)".
    std::string platform() const;
};

// From the text of /proc/cpuinfo, of its first processor.
Cpu read_cpuinfo(std::istream& cpuinfo);

Cpu host_cpu();
std::string cpu_name();  // host_cpu()'s
std::string cpu_vendor();

}  // namespace mandelmarch
