// SPDX-License-Identifier: Apache-2.0
// A device's process: does what the program asks for, with the real backend.
#pragma once

#include "core/isolation/channel.h"
#include "core/render/backend.h"

namespace mandelmarch::isolation {

// Answers requests until the program hangs up, then ends the process.
[[noreturn]] void serve(const Backend& backend, const Channel& channel);

}  // namespace mandelmarch::isolation
