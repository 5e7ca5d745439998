// SPDX-License-Identifier: Apache-2.0
#include "flight/film/tent.h"

#include <algorithm>
#include <cstddef>

#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr unsigned middle = 6;  // weight of the pixel itself, in tenths; each of its four neighbours has one tenth
constexpr unsigned whole = 10;
constexpr std::size_t grain = 16;  // rows that a thread takes at once

}  // namespace

std::vector<std::uint8_t> softened(const Image& picture, int threads)
{
    const auto rows = static_cast<std::size_t>(picture.height());
    const std::size_t pitch = 3 * static_cast<std::size_t>(picture.width());
    std::vector<std::uint8_t> rgb(rows * pitch);
    const std::uint8_t* bytes = picture.bytes().data();
    parallel(rows, grain, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            const std::uint8_t* here = bytes + (rows - 1 - y) * pitch;
            const std::uint8_t* above = y > 0 ? here + pitch : here;
            const std::uint8_t* below = y + 1 < rows ? here - pitch : here;
            std::uint8_t* to = rgb.data() + y * pitch;
            const auto mixed = [&](std::size_t i, std::size_t left, std::size_t right) {
                // The sum has 16 bits, so that a vector register holds many sums.
                const auto sum = static_cast<std::uint16_t>(middle * here[i] + here[left] + here[right] + above[i] +
                                                            below[i] + whole / 2);
                return static_cast<std::uint8_t>(sum / whole);
            };
            for (std::size_t i = 0; i < 3; ++i) to[i] = mixed(i, i, std::min(i + 3, pitch - 3 + i));
            for (std::size_t i = 3; i + 3 < pitch; ++i) to[i] = mixed(i, i - 3, i + 3);
            for (std::size_t i = std::max<std::size_t>(pitch - 3, 3); i < pitch; ++i) to[i] = mixed(i, i - 3, i);
        }
    });
    return rgb;
}

}  // namespace mandelmarch
