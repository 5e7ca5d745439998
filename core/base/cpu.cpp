#include "core/base/cpu.h"

#include <fstream>
#include <string_view>

namespace mandelmarch {
namespace {

std::string from_cpuinfo(std::string_view key, const char* otherwise)
{
    std::ifstream file("/proc/cpuinfo");
    std::string line;
    while (std::getline(file, line)) {
        const auto colon = line.find(": ");
        if (line.starts_with(key) && colon != std::string::npos) return line.substr(colon + 2);
    }
    return otherwise;
}

}  // namespace

std::string cpu_name() { return from_cpuinfo("model name", "CPU"); }

std::string cpu_vendor() { return from_cpuinfo("vendor_id", "unknown"); }

}  // namespace mandelmarch
