// SPDX-License-Identifier: Apache-2.0
// The kernels of this backend's simulated device.
#pragma once

#include <cstddef>
#include <string_view>

namespace mandelmarch::skeleton {

// Renders rows [first_row, first_row + rows) of the picture into a device's buffers, with the layout of
// core/image/image.h and `pixels` values per plane. `scene` is the kernel's Scene in Real's layout.
template <class Real>
using DrawBand = void (*)(const void* scene, int first_row, int rows, std::size_t pixels, Real* reals, int* wholes);

struct Kernel {
    DrawBand<double> in_double;
    DrawBand<float> in_float;
};

// Returns a fractal's kernels; nullptr if the fractal is unknown.
const Kernel* kernel_of(std::string_view name);

}  // namespace mandelmarch::skeleton
