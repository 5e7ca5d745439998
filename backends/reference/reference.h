// SPDX-License-Identifier: Apache-2.0
// The reference backend: a simple serial renderer in double precision. It shares no formula with the kernel; for
// example, its Mandelbulb uses trigonometric functions. It provides the expected pictures and the baseline times.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_reference_backend();

}  // namespace mandelmarch
