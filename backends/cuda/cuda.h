// SPDX-License-Identifier: Apache-2.0
// The cuda backend: the kernel in CUDA, on NVIDIA GPUs.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_cuda_backend();

}  // namespace mandelmarch
