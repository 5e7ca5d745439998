// SPDX-License-Identifier: Apache-2.0
// The OpenMP backend: the kernel on all cores of this machine. A core processes one pixel at a time, or a pack: a
// vector of pixels, one or more SIMD registers wide.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_openmp_backend();

}  // namespace mandelmarch
