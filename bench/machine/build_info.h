// SPDX-License-Identifier: Apache-2.0
// Build type, compiler and flags of bench. CMake writes them into build_info.cpp when the project is configured.
#pragma once

#include <string>

namespace mandelmarch::bench {

struct BuildInfo {
    std::string type;      // CMAKE_BUILD_TYPE
    std::string compiler;  // name and version
    std::string flags;     // common to all sources
};

BuildInfo build_info();

}  // namespace mandelmarch::bench
