// SPDX-License-Identifier: Apache-2.0
// The OpenACC backend: the kernel text on NVIDIA GPUs, and on one thread of the host where there is none.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_openacc_backend();

}  // namespace mandelmarch
