// SPDX-License-Identifier: Apache-2.0
// The device process's side: serves the program's requests with the real backend.
#pragma once

#include "core/isolation/channel.h"
#include "core/render/backend.h"

namespace mandelmarch::isolation {

// Serves requests until the program closes the channel, then ends the process.
[[noreturn]] void serve(const Backend& backend, const Channel& channel);

}  // namespace mandelmarch::isolation
