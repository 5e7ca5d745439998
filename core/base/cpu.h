// What CPU this is.
#pragma once

#include <string>

namespace mandelmarch {

std::string cpu_name();  // as the CPU calls itself, "CPU" where unknown
std::string cpu_vendor();

}  // namespace mandelmarch
