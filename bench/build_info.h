// SPDX-License-Identifier: Apache-2.0
// How this program was built. Generated when the project is configured. core/base/version.h has its version.
#pragma once

#include <string>

namespace mandelmarch::bench {

struct BuildInfo {
    std::string type;      // CMAKE_BUILD_TYPE
    std::string compiler;  // name and version
    std::string flags;     // of all sources
};

BuildInfo build_info();

}  // namespace mandelmarch::bench
