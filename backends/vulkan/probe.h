// SPDX-License-Identifier: Apache-2.0
// Tests if a device follows IEEE 754: Vulkan allows errors of 2.5 ulp in divisions and square roots, and some drivers
// ignore NoContraction.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/vulkan/program.h"

namespace mandelmarch::vulkan {

// Objects in use by a device. Separate from the code that uses them, so that they can be abandoned together with a
// device that does not respond.
struct Workbench {
    std::unique_ptr<Program> program;
    std::vector<Buffer> buffers;
};

// Returns the name suffix of the modules with which this device is exact: "", or, if its float divisions are inexact,
// "_corrected" or "_pinned" (modules.h). Throws Unavailable if none is exact.
std::string exact_modules(Gpu& gpu, Workbench& bench, Precision precision);

}  // namespace mandelmarch::vulkan
