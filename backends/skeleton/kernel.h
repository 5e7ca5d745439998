// SPDX-License-Identifier: Apache-2.0
// The kernels of this backend's simulated device.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/render/kernel_scene.h"

namespace mandelmarch::skeleton {

// Renders rows [first_row, first_row + rows) of the picture into a device's buffers, with the layout of
// core/image/image.h and `pixels` values per plane.
template <class Real>
using DrawBand = void(const KernelScene<Real>& scene, int first_row, int rows, std::size_t pixels, Real* reals,
                      int* wholes);

// Returns the kernel generated for "FRACTAL_PRECISION" (CMakeLists.txt); nullptr if the fractal is unknown.
template <class Real>
DrawBand<Real>* kernel_of(std::string_view variant);

}  // namespace mandelmarch::skeleton
