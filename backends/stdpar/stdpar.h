// SPDX-License-Identifier: Apache-2.0
// The stdpar backend: the kernel text in C++ standard parallelism's std::for_each, on all cores.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_stdpar_backend();

}  // namespace mandelmarch
