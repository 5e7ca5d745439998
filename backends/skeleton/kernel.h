// SPDX-License-Identifier: Apache-2.0
// What this backend's "device" runs.
#pragma once

#include <cstddef>
#include <string_view>

namespace mandelmarch::skeleton {

// Draws rows [first_row, first_row + rows) of the picture into a device's buffers, laid out as core/image/image.h says,
// with `pixels` values in each plane. `scene` is the text's Scene in Real's layout.
template <class Real>
using DrawBand = void (*)(const void* scene, int first_row, int rows, std::size_t pixels, Real* reals, int* wholes);

struct Kernel {
    DrawBand<double> in_double;
    DrawBand<float> in_float;
};

// nullptr for a fractal that this backend does not know.
const Kernel* kernel_of(std::string_view name);

}  // namespace mandelmarch::skeleton
