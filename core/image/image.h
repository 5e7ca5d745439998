// SPDX-License-Identifier: Apache-2.0
// A rendered picture in memory.
//     Image image(640, 480, Image::Layers::all);
//     const std::uint8_t red = image.bytes()[3 * (y * 640 + x)];  // y = 0 is the bottom row
//     const double depth = image.values()[y * 640 + x].depth;
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "core/image/tile.h"

namespace mandelmarch {

inline constexpr int max_side = 65535;  // max width and height of a picture, pixels

// A pixel as computed by a backend.
struct PixelValue {
    double red = 0, green = 0, blue = 0;  // 0 to 1, as displayed
    double depth = 0;                     // +infinity: no hit
    std::int32_t steps = 0;
    std::int32_t iterations = 0;
};

// Finished pixels in a backend's memory, one plane for each value. Pixel (x, y) has index y * stride + x in every
// plane. Real is the kernel's floating-point type.
template <class Real>
struct Planes {
    const Real* red;  // 0 to 1, as displayed
    const Real* green;
    const Real* blue;
    const Real* depth;  // +infinity: no hit
    const int* steps;
    const int* de_calls;
    const int* iterations;
    std::size_t stride;  // pixels
};

// Returns the planes of a device's buffers. Each plane has `pixels` values. `reals` contains real_planes planes (red,
// green, blue, depth), `wholes` contains whole_planes (steps, DE evaluations, iterations).
template <class Real>
Planes<Real> planes_of(const Real* reals, const int* wholes, std::size_t pixels, std::size_t stride);

// A picture. Rows go from bottom to top: pixel (x, y) has index y * width + x, and y = 0 is the bottom row.
class Image {
public:
    // Values stored in addition to a pixel's three bytes: none; the colours that the bytes come from; or all of
    // PixelValue.
    enum class Layers { bytes, colours, all };

    Image() = default;
    // Makes a black image, allocated from `memory`; copies of it use the heap. If the image is a part of a larger
    // picture, it begins at row `first_row` of that picture.
    Image(int width, int height, Layers layers, std::pmr::memory_resource* memory = std::pmr::get_default_resource(),
          int first_row = 0);

    int width() const { return width_; }
    int height() const { return height_; }
    int first_row() const { return first_row_; }
    int end_row() const { return first_row_ + height_; }
    std::size_t pixels() const { return pixels(width_, height_); }
    static std::size_t pixels(int width, int height)
    {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    Layers layers() const { return layers_; }
    bool has_values() const { return layers_ != Layers::bytes; }
    bool has_depths() const { return layers_ == Layers::all; }

    // Returns three bytes per pixel: red, green and blue.
    const std::pmr::vector<std::uint8_t>& bytes() const { return bytes_; }
    std::pmr::vector<std::uint8_t>& bytes() { return bytes_; }

    // Returns the first byte of a row. `row` is an index in the larger picture.
    std::uint8_t* row_bytes(int row) { return bytes_.data() + 3 * pixels(width_, row - first_row_); }

    // Returns the values of all pixels; empty for Layers::bytes. With Layers::colours, depth, steps and iterations are
    // 0 and meaningless.
    const std::pmr::vector<PixelValue>& values() const { return values_; }
    std::pmr::vector<PixelValue>& values() { return values_; }

    // Stores the planes' pixels (0, 0) to (width - 1, height - 1) into the image. Pixel (0, 0) of the planes becomes
    // pixel (left, bottom); `bottom` is a row of the larger picture. A byte is trunc(255 c), computed in the planes'
    // precision. Several threads may store different parts of an image at the same time.
    template <class Real>
    void store(const Planes<Real>& planes, int left, int bottom, int width, int height);

    // Returns the memory that an image needs, in bytes per pixel.
    static std::size_t bytes_per_pixel(Layers layers);

private:
    int width_ = 0;
    int height_ = 0;
    int first_row_ = 0;
    Layers layers_ = Layers::bytes;
    std::pmr::vector<std::uint8_t> bytes_;
    std::pmr::vector<PixelValue> values_;
};

}  // namespace mandelmarch
