// SPDX-License-Identifier: Apache-2.0
#include "backends/opencl/pocl_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace mandelmarch::opencl {
namespace {

namespace fs = std::filesystem;

std::string variable(const char* name)
{
    const char* value = std::getenv(name);
    return value == nullptr ? std::string() : value;
}

// Returns the default cache folder of PoCL 3.1: pocl/kcache in $XDG_CACHE_HOME, or else in ~/.cache; empty if neither
// variable is set.
std::string usual_folder()
{
    if (const std::string caches = variable("XDG_CACHE_HOME"); !caches.empty()) return caches + "/pocl/kcache";
    if (const std::string home = variable("HOME"); !home.empty()) return home + "/.cache/pocl/kcache";
    return {};
}

bool can_be_made(const std::string& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    return access(folder.c_str(), W_OK | X_OK) == 0;
}

// Returns true if the folder belongs to this user and nobody else can access it. In a shared temporary folder, another
// user may have created a folder of this name.
bool is_private(const std::string& folder)
{
    struct stat status {};
    return lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) && status.st_uid == geteuid() &&
           (status.st_mode & 077) == 0;
}

}  // namespace

void provide_pocl_cache()
{
    if (!variable("POCL_CACHE_DIR").empty()) return;
    unsetenv("POCL_CACHE_DIR");  // PoCL treats an empty value as a folder
    if (const std::string usual = usual_folder(); !usual.empty() && can_be_made(usual)) return;
    std::error_code error;
    const fs::path temporary = fs::temp_directory_path(error);
    if (error) return;
    const std::string folder = (temporary / fmt::format("mandelmarch-pocl-{}", geteuid())).string();
    mkdir(folder.c_str(), 0700);
    if (is_private(folder)) setenv("POCL_CACHE_DIR", folder.c_str(), 1);
}

}  // namespace mandelmarch::opencl
