// SPDX-License-Identifier: Apache-2.0
// The OpenACC backend: the kernel on NVIDIA GPUs, or on one thread of the host if none is present.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_openacc_backend();

}  // namespace mandelmarch
