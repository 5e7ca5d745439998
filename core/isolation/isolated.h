// SPDX-License-Identifier: Apache-2.0
// Protects a program from drivers that crash, hang or end their process.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

// Returns a backend that uses each device of `backend` in a separate process. If a driver ends its process, the call
// throws Error, and the next call starts a new process; a crash affects no other call. If a driver does not respond for
// device_timeout() seconds, the call throws Error, too, and its device is not used again. unavailable() and devices()
// throw Error if the driver fails while listing its devices.
//
// Must be called before the program has threads.
std::unique_ptr<Backend> isolated(std::unique_ptr<Backend> backend);

}  // namespace mandelmarch
