// SPDX-License-Identifier: Apache-2.0
#include "core/image/image.h"

namespace mandelmarch {

Image::Image(int width, int height, Layers layers, std::pmr::memory_resource* memory, int first_row)
    : width_(width), height_(height), first_row_(first_row), layers_(layers), bytes_(memory), values_(memory)
{
    bytes_.resize(3 * pixels());
    if (layers != Layers::bytes) values_.resize(pixels());
}

std::size_t Image::bytes_per_pixel(Layers layers) { return layers == Layers::bytes ? 3 : 3 + sizeof(PixelValue); }

template <class Real>
Planes<Real> planes_of(const Real* reals, const int* wholes, std::size_t pixels, std::size_t stride)
{
    return {reals,  reals + pixels,  reals + 2 * pixels,  reals + 3 * pixels,
            wholes, wholes + pixels, wholes + 2 * pixels, stride};
}

template Planes<float> planes_of(const float*, const int*, std::size_t, std::size_t);
template Planes<double> planes_of(const double*, const int*, std::size_t, std::size_t);

template <class Real>
void Image::store(const Planes<Real>& planes, int left, int bottom, int width, int height)
{
    // Converts a colour to a byte. NaN becomes 0.
    const auto byte = [](Real c) { return static_cast<std::uint8_t>(c > 0 ? 255 * (c < 1 ? c : 1) : 0); };
    for (int y = 0; y < height; ++y) {
        const std::size_t row = pixels(width_, bottom + y - first_row_);
        for (int x = 0; x < width; ++x) {
            const std::size_t from = static_cast<std::size_t>(y) * planes.stride + static_cast<std::size_t>(x);
            const std::size_t to = row + static_cast<std::size_t>(left + x);
            bytes_[3 * to] = byte(planes.red[from]);
            bytes_[3 * to + 1] = byte(planes.green[from]);
            bytes_[3 * to + 2] = byte(planes.blue[from]);
            if (!has_values()) continue;
            values_[to] = {planes.red[from],   planes.green[from], planes.blue[from],
                           planes.depth[from], planes.steps[from], planes.iterations[from]};
        }
    }
}

template void Image::store(const Planes<float>&, int, int, int, int);
template void Image::store(const Planes<double>&, int, int, int, int);

}  // namespace mandelmarch
