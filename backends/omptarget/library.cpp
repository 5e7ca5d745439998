// SPDX-License-Identifier: Apache-2.0
#include "backends/omptarget/library.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace mandelmarch::omptarget {
namespace {

std::string failed(const char* what)
{
    return fmt::format("its kernels cannot be loaded: {}: {}", what, strerror(errno));
}

// Loads the library from an anonymous file in memory, because dlopen() accepts only files.
Library loaded()
{
    const int file = memfd_create("omptarget_kernels", MFD_CLOEXEC);
    if (file < 0) return {nullptr, failed("memfd_create")};
    const char* at = mandelmarch_omptarget_library;
    while (at != mandelmarch_omptarget_library_end) {
        const ssize_t written = write(file, at, static_cast<std::size_t>(mandelmarch_omptarget_library_end - at));
        if (written < 0 && errno != EINTR) {
            Library none{nullptr, failed("write")};
            close(file);
            return none;
        }
        if (written > 0) at += written;
    }
    Library made;
    made.handle = dlopen(fmt::format("/proc/self/fd/{}", file).c_str(), RTLD_NOW | RTLD_LOCAL);
    if (made.handle == nullptr) made.failure = fmt::format("its kernels cannot be loaded: {}", dlerror());
    close(file);
    return made;
}

}  // namespace

const Library& library()
{
    static const Library only = loaded();
    return only;
}

void* symbol(const std::string& name)
{
    return library().handle == nullptr ? nullptr : dlsym(library().handle, name.c_str());
}

}  // namespace mandelmarch::omptarget
