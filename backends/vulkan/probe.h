// SPDX-License-Identifier: Apache-2.0
// Tests whether a device follows IEEE 754. Vulkan allows divisions an error of 2.5 ulp and does not require exact
// square roots, and some drivers ignore NoContraction.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "backends/vulkan/program.h"

namespace mandelmarch::vulkan {

// Objects that a device uses. They are separate from the code that uses them, so that they can be abandoned together
// with a device that does not respond.
struct Workbench {
    std::unique_ptr<Program> program;
    std::vector<Buffer> buffers;
};

// Returns the suffix of the modules that are exact on this device: "", or "_corrected" (program.h) if the device's own
// float divisions are inexact. Throws Unavailable if no module is exact, or if the device fuses multiplications with
// additions.
std::string exact_modules(Gpu& gpu, Workbench& bench, Precision precision);

}  // namespace mandelmarch::vulkan
