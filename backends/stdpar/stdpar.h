// SPDX-License-Identifier: Apache-2.0
// The stdpar backend: the kernel in std::for_each of C++ standard parallelism, on all cores.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_stdpar_backend();

}  // namespace mandelmarch
