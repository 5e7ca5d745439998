// SPDX-License-Identifier: Apache-2.0
#include "flight/film/shrink.h"

#include <algorithm>
#include <numeric>

#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

// The part of a sample that lies in a pixel.
struct Share {
    std::size_t sample;
    std::uint64_t weight;
};

// The weights with which `samples` samples are averaged to `pixels` pixels along one side of the picture. Pixel i is
// the weighted mean of the shares all[first[i]] to all[first[i + 1] - 1]; their weights add up to `whole`.
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
    parallel(rows, 16, threads, [&](std::size_t begin, std::size_t end) {
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

}  // namespace mandelmarch
