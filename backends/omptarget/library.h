// SPDX-License-Identifier: Apache-2.0
// The shared library of kernels, which is embedded in the program.
#pragma once

#include <string>

extern "C" {
extern const char mandelmarch_omptarget_library[];
extern const char mandelmarch_omptarget_library_end[];
}

namespace mandelmarch::omptarget {

// The loaded shared library. library() loads it on the first call.
struct Library {
    void* handle = nullptr;
    std::string failure;  // why the handle is null
};
const Library& library();

// Returns the address of a function of the library; nullptr if the library is not loaded or has no such function.
void* symbol(const std::string& name);

}  // namespace mandelmarch::omptarget
