// SPDX-License-Identifier: Apache-2.0
// Backends whose drivers may crash, hang or end the process.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

// The backend, with each of its devices in a process of its own: a driver that ends its process fails there with Error,
// as does one that does not answer for device_timeout() seconds, which is not asked again. A crash spoils nothing but
// the call in which it happens: the next one has a new process. `unavailable()` and `devices()` throw the same where
// the driver fails while it lists devices.
//
// Must be called while the program has no threads; fractals that are registered later are not known there.
std::unique_ptr<Backend> isolated(std::unique_ptr<Backend> backend);

}  // namespace mandelmarch
