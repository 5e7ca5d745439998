// SPDX-License-Identifier: Apache-2.0
// Whether a device computes as IEEE 754 says: Vulkan lets quotients and roots be off by 2.5 units in the last place,
// and not every driver heeds NoContraction.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/vulkan/program.h"

namespace mandelmarch::vulkan {

// All that a device works with. It is kept apart from the code that uses it, so that it can be left behind together
// with a device that does not answer.
struct Workbench {
    std::unique_ptr<Program> program;
    std::vector<Buffer> buffers;
};

// The ending of the names of the modules that keep exact mode's promise on this device: "", or for its inexact float
// quotients "_corrected" or "_pinned" (modules.h). Throws Unavailable if there are none.
std::string exact_modules(Gpu& gpu, Workbench& bench, Precision precision);

}  // namespace mandelmarch::vulkan
