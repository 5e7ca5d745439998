// SPDX-License-Identifier: Apache-2.0
#include "bench/counting/sample.h"

#include <algorithm>
#include <cstddef>
#include <random>

namespace mandelmarch::bench {
namespace {

constexpr std::uint64_t seed = 1;

// Returns the patch's position on Morton's curve, which interleaves the bits of the patch's column and row.
std::uint64_t place(const Block& block)
{
    std::uint64_t bits = 0;
    for (int bit = 0; bit < 32; ++bit) {
        bits |= (static_cast<std::uint64_t>(block.column / block_side) >> bit & 1) << 2 * bit;
        bits |= (static_cast<std::uint64_t>(block.row / block_side) >> bit & 1) << (2 * bit + 1);
    }
    return bits;
}

// Divides the numbers 0 ... count - 1 into strata of equal length and returns a random number from each, in rising
// order. Two neighbouring strata may both return the number at their common end.
std::vector<std::size_t> one_of_each(std::int64_t strata, std::size_t count)
{
    const double length = static_cast<double>(count) / static_cast<double>(strata);
    std::mt19937_64 random(seed);
    std::vector<std::size_t> drawn;
    for (std::int64_t i = 0; i < strata; ++i) {
        const double within = 0x1p-53 * static_cast<double>(random() >> 11);  // 0 to 1
        const auto at = static_cast<std::size_t>((static_cast<double>(i) + within) * length);
        drawn.push_back(std::min(at, count - 1));
    }
    return drawn;
}

}  // namespace

std::vector<Block> all_blocks(int width, int height)
{
    std::vector<Block> blocks;
    for (int row = 0; row < height; row += block_side) {
        for (int column = 0; column < width; column += block_side) blocks.push_back({column, row});
    }
    std::ranges::sort(blocks, {}, place);
    return blocks;
}

std::vector<Block> sample_of_blocks(int width, int height, std::int64_t most)
{
    const std::vector<Block> all = all_blocks(width, height);
    const auto strata = std::clamp<std::int64_t>(most / (std::int64_t{block_side} * block_side), 1, std::ssize(all));
    std::vector<Block> sample;
    for (const std::size_t at : one_of_each(strata, all.size())) sample.push_back(all[at]);
    return sample;
}

std::vector<Block> sample_of_pixels(int width, int height, std::int64_t most)
{
    const std::int64_t pixels = std::int64_t{width} * height;
    const std::vector<std::size_t> drawn =
        one_of_each(std::clamp<std::int64_t>(most, 1, pixels), static_cast<std::size_t>(pixels));
    std::vector<Block> sample;
    std::size_t at = 0;
    for (const Block& block : all_blocks(width, height)) {
        each_pixel(block, width, height, [&](int column, int row) {
            for (; sample.size() < drawn.size() && drawn[sample.size()] == at;)
                sample.push_back({.column = column, .row = row, .side = 1});
            ++at;
        });
    }
    return sample;
}

}  // namespace mandelmarch::bench
