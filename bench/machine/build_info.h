// SPDX-License-Identifier: Apache-2.0
// How bench was built. Generated at configure time. The version is in core/base/version.h.
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
