// SPDX-License-Identifier: Apache-2.0
// Queries of devices that OpenMP does not have, and each compiler's run-time library may have.
#pragma once

#include <cstddef>
#include <optional>

#include "core/models/model.h"

namespace mandelmarch::omptarget {

extern const char* const kind;  // the devices' kind, for messages: "NVIDIA GPU"

// Opens a device, whose driver then loads the kernels. `chains` is one of the kernels; it may be null, and loading may
// then be delayed until the first kernel runs.
job::OpenedDevice opened(int index, job::Chains* chains);

// Returns the free memory of a device, in bytes; nullopt if it is unknown.
std::optional<std::size_t> free_memory(int index);

}  // namespace mandelmarch::omptarget
