// SPDX-License-Identifier: Apache-2.0
// Isolation of backends whose drivers may crash, hang or end the process.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

// Returns the backend with each of its devices in a separate process. A driver that ends that process causes Error; so
// does one that does not respond for device_timeout() seconds, and its device is then not used again. A crash affects
// only the call in which it occurs: the next call starts a new process. `unavailable()` and `devices()` throw the same
// if the driver fails while listing devices.
//
// Call it while the program has no threads; fractals registered later are unknown in the device processes.
std::unique_ptr<Backend> isolated(std::unique_ptr<Backend> backend);

}  // namespace mandelmarch
