// SPDX-License-Identifier: Apache-2.0
// The kernels, a shared library that the program carries within itself.
#pragma once

#include <string>

extern "C" {
extern const char mandelmarch_omptarget_library[];
extern const char mandelmarch_omptarget_library_end[];
}

namespace mandelmarch::omptarget {

// Loaded once, when first asked for.
struct Library {
    void* handle = nullptr;
    std::string failure;  // why there is no handle
};
const Library& library();

// Of a function; nullptr where there is none.
void* symbol(const std::string& name);

}  // namespace mandelmarch::omptarget
