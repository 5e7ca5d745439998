// SPDX-License-Identifier: Apache-2.0
// Every backend there is, built or not.
#pragma once

#include "core/render/registry.h"

namespace mandelmarch {

// Where devices' drivers run.
enum class Drivers {
    in_this_process,
    isolated  // each device in a process of its own (core/isolation/isolated.h); before the program has threads
};

Registry all_backends(Drivers drivers = Drivers::in_this_process);

}  // namespace mandelmarch
