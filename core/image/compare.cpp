// SPDX-License-Identifier: Apache-2.0
#include "core/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr int visible = 2;  // max difference of a byte that counts as invisible, in all comparisons of this project

bool same_bits(double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); }

bool same_colour(const PixelValue& a, const PixelValue& b)
{
    return same_bits(a.red, b.red) && same_bits(a.green, b.green) && same_bits(a.blue, b.blue);
}

int largest_difference(const Image& a, const Image& b, std::size_t pixel)
{
    int largest = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        largest = std::max(largest, std::abs(int{a.bytes()[i]} - int{b.bytes()[i]}));
    }
    return largest;
}

void require_same_size(const Image& a, const Image& b)
{
    if (a.width() == b.width() && a.height() == b.height()) return;
    throw InputError(fmt::format("the pictures have {} x {} and {} x {} pixels, expected the same size", a.width(),
                                 a.height(), b.width(), b.height()));
}

}  // namespace

Comparison compare(const Image& a, const Image& b)
{
    require_same_size(a, b);
    Comparison result;
    result.pixels = a.pixels();
    result.values_compared = a.has_values() && b.has_values();
    result.depths_compared = a.has_depths() && b.has_depths();
    std::uint64_t squares = 0;
    for (std::size_t i = 0; i < 3 * a.pixels(); ++i) {
        const int difference = int{a.bytes()[i]} - int{b.bytes()[i]};
        squares += static_cast<std::uint64_t>(difference * difference);
    }
    for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel) {
        const int difference = largest_difference(a, b, pixel);
        bool same = difference == 0;
        result.differing += difference > 0;
        result.visibly_differing += difference > visible;
        result.largest = std::max(result.largest, difference);
        if (result.values_compared) {
            const PixelValue& from = a.values()[pixel];
            const PixelValue& to = b.values()[pixel];
            const bool colour = same_colour(from, to);
            result.differing_colours += !colour;
            same = same && colour;
            if (result.depths_compared) {
                const bool depth = same_bits(from.depth, to.depth);
                result.differing_depths += !depth;
                result.hit_or_miss += std::isinf(from.depth) != std::isinf(to.depth);
                same = same && depth;
            }
        }
        if (!same && result.first < 0) result.first = static_cast<std::int64_t>(pixel);
    }
    const double mean_square = static_cast<double>(squares) / static_cast<double>(3 * a.pixels());
    result.psnr = squares == 0 ? std::numeric_limits<double>::infinity() : 10 * std::log10(255.0 * 255.0 / mean_square);
    return result;
}

std::string describe_pixel(const Image& a, const Image& b, std::int64_t index)
{
    const auto pixel = static_cast<std::size_t>(index);
    const auto value = [pixel](const Image& image) {
        const std::uint8_t* byte = image.bytes().data() + 3 * pixel;
        std::string text = fmt::format("({}, {}, {})", byte[0], byte[1], byte[2]);
        if (image.has_values()) {
            const PixelValue& v = image.values()[pixel];
            text += fmt::format(" = ({:.17g}, {:.17g}, {:.17g})", v.red, v.green, v.blue);
            if (image.has_depths()) text += fmt::format(" depth {:.17g}", v.depth);
        }
        return text;
    };
    return fmt::format("pixel ({}, {}): {} against {}", index % a.width(), index / a.width(), value(a), value(b));
}

Image difference_map(const Image& a, const Image& b)
{
    require_same_size(a, b);
    Image map(a.width(), a.height(), Image::Layers::bytes);
    for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel) {
        const int difference = largest_difference(a, b, pixel);
        const auto level = static_cast<std::uint8_t>(difference == 0 ? 255 : 200 * (255 - difference) / 255);
        std::fill_n(map.bytes().begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, level);
    }
    return map;
}

}  // namespace mandelmarch
