// SPDX-License-Identifier: Apache-2.0
// The reference backend: a simple serial renderer in double precision. Its Mandelbulb uses trigonometric functions. It
// shares no formula with the kernel, and provides the expected pictures and the baseline times.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_reference_backend();

}  // namespace mandelmarch
