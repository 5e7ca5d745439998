// SPDX-License-Identifier: Apache-2.0
#include "flight/film/shrink.h"

#include <algorithm>
#include <numeric>

#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr unsigned middle = 6;  // weight of the pixel itself, in tenths; each of its four neighbours has one tenth
constexpr unsigned tenths = 10;
constexpr std::size_t grain = 16;  // rows that a thread takes at once

// The part of a sample that lies in a pixel.
struct Share {
    std::size_t sample;
    std::uint64_t weight;
};

// The weights with which `samples` samples are averaged to `pixels` pixels along one side of the picture. Pixel i is
// the weighted mean of the shares all[first[i]] to all[first[i + 1] - 1]. The weights of these shares add up to
// `whole`.
struct Shares {
    std::vector<Share> all;
    std::vector<std::size_t> first;
    std::uint64_t whole = 0;

    Shares(int samples, int pixels)
    {
        const auto common = static_cast<std::uint64_t>(std::gcd(samples, pixels));
        // Lengths are integers in a common unit: a sample is `sample` long, a pixel is `whole` long.
        const std::uint64_t sample = static_cast<std::uint64_t>(pixels) / common;
        whole = static_cast<std::uint64_t>(samples) / common;
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(pixels); ++i) {
            first.push_back(all.size());
            for (std::uint64_t at = i * whole; at < (i + 1) * whole;) {
                const std::uint64_t next = std::min((at / sample + 1) * sample, (i + 1) * whole);
                all.push_back({static_cast<std::size_t>(at / sample), next - at});
                at = next;
            }
        }
        first.push_back(all.size());
    }
};

}  // namespace

std::vector<std::uint8_t> shrunk(const Image& picture, int width, int height, int threads)
{
    const Shares across(picture.width(), width);
    const Shares down(picture.height(), height);
    const std::uint64_t whole = across.whole * down.whole;
    const auto rows = static_cast<std::size_t>(height);
    const std::size_t pitch = 3 * static_cast<std::size_t>(width);
    const std::size_t from_pitch = 3 * static_cast<std::size_t>(picture.width());
    std::vector<std::uint8_t> rgb(rows * pitch);
    parallel(rows, grain, threads, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint64_t> sums(pitch);
        for (std::size_t y = begin; y < end; ++y) {
            sums.assign(pitch, whole / 2);
            for (std::size_t j = down.first[y]; j < down.first[y + 1]; ++j) {
                const auto row = static_cast<std::size_t>(picture.height()) - 1 - down.all[j].sample;
                const std::uint8_t* from = picture.bytes().data() + row * from_pitch;
                for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
                    for (std::size_t i = across.first[x]; i < across.first[x + 1]; ++i) {
                        const std::uint64_t weight = across.all[i].weight * down.all[j].weight;
                        const std::uint8_t* sample = from + 3 * across.all[i].sample;
                        for (std::size_t c = 0; c < 3; ++c) sums[3 * x + c] += weight * sample[c];
                    }
                }
            }
            for (std::size_t i = 0; i < pitch; ++i) rgb[y * pitch + i] = static_cast<std::uint8_t>(sums[i] / whole);
        }
    });
    return rgb;
}

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
                                                            below[i] + tenths / 2);
                return static_cast<std::uint8_t>(sum / tenths);
            };
            for (std::size_t i = 0; i < 3; ++i) to[i] = mixed(i, i, std::min(i + 3, pitch - 3 + i));
            for (std::size_t i = 3; i + 3 < pitch; ++i) to[i] = mixed(i, i - 3, i + 3);
            for (std::size_t i = std::max<std::size_t>(pitch - 3, 3); i < pitch; ++i) to[i] = mixed(i, i - 3, i);
        }
    });
    return rgb;
}

}  // namespace mandelmarch
