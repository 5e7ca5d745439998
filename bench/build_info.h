// How this program was built. Generated: flags when configured, the git revision at every build.
#pragma once

#include <string>
#include <string_view>

namespace mandelmarch::bench {

struct BuildInfo {
    std::string version;   // of the project
    std::string type;      // CMAKE_BUILD_TYPE
    std::string compiler;  // name and version
    std::string flags;     // of all sources
    std::string revision;  // git's, "unknown" outside a repository
    bool dirty = false;    // tracked files outside report/results differed from the revision
};

BuildInfo build_info();

// The compiler of a backend's kernels and its floating-point flags in each mode; empty where unknown.
struct BackendBuild {
    std::string compiler, exact, fast;
};

BackendBuild build_of(std::string_view backend);

}  // namespace mandelmarch::bench
