// SPDX-License-Identifier: Apache-2.0
// The reference backend: a plain serial renderer in double, trigonometric Mandelbulb and all, which shares no formula
// with the kernel text. It is the yardstick of every other picture, and of every speed.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_reference_backend();

}  // namespace mandelmarch
