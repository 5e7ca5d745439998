// SPDX-License-Identifier: Apache-2.0
// The omptarget backend: the kernel in OpenMP's target directives, on NVIDIA GPUs or on the host's cores.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_omptarget_backend();

}  // namespace mandelmarch
