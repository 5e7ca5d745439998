// SPDX-License-Identifier: Apache-2.0
// Dependencies bundled with the programs: drivers for CPUs, a font, optionally ffmpeg.
#pragma once

#include <filesystem>

namespace mandelmarch {

// Returns the folder that holds bin/, lib/ and share/.
std::filesystem::path bundle_folder();

// Sets environment variables for the loaders of OpenCL and Vulkan, and for the film, before anything is loaded. The
// system's drivers stay available. A bundled driver is left out if the system has the same one. Variables that are
// already set are not changed.
void use_carried(const std::filesystem::path& bundle);

}  // namespace mandelmarch
