// SPDX-License-Identifier: Apache-2.0
// What a bundle carries beside the programs: drivers for CPUs, a font, perhaps ffmpeg.
#pragma once

#include <filesystem>

namespace mandelmarch {

// The folder that holds bin/, lib/ and share/.
std::filesystem::path bundle_folder();

// Tells the loaders of OpenCL and Vulkan, and the film, where these are: by the environment, before anything is loaded.
// The system's drivers stay. A carried driver is left out where the system has the same one; a variable that is set
// stays.
void use_carried(const std::filesystem::path& bundle);

}  // namespace mandelmarch
