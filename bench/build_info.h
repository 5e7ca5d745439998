// SPDX-License-Identifier: Apache-2.0
// How this program was built. Generated when the project is configured. core/base/version.h has its version.
#pragma once

#include <string>
#include <string_view>

namespace mandelmarch::bench {

struct BuildInfo {
    std::string type;      // CMAKE_BUILD_TYPE
    std::string compiler;  // name and version
    std::string flags;     // of all sources
};

BuildInfo build_info();

// The compiler of a backend's kernels and its floating-point flags in each mode; empty where unknown.
struct BackendBuild {
    std::string compiler, exact, fast;
};

BackendBuild build_of(std::string_view backend);

}  // namespace mandelmarch::bench
