// SPDX-License-Identifier: Apache-2.0
// Parts of a picture that stand for all of it: single pixels, and blocks of neighbouring pixels, as vectors and warps
// take them.
#pragma once

#include <cstdint>
#include <vector>

namespace mandelmarch::bench {

inline constexpr int block_side = 16;  // pixels

// A square of pixels. Those that lie outside the picture do not belong to it.
struct Block {
    int column = 0, row = 0;  // of its first pixel
    int side = block_side;    // a power of two
};

// Calls each(column, row) for the block's pixels inside the picture, along Morton's curve: a power of two of them fills
// a rectangle of at most twice as many columns as rows.
template <class Each>
void each_pixel(const Block& block, int width, int height, Each each)
{
    for (int at = 0; at < block.side * block.side; ++at) {
        int column = block.column;
        int row = block.row;
        for (int bit = 0; 1 << bit < block.side; ++bit) {
            column += (at >> 2 * bit & 1) << bit;
            row += (at >> (2 * bit + 1) & 1) << bit;
        }
        if (column < width && row < height) each(column, row);
    }
}

// All blocks of a picture, along Morton's curve: neighbours in the list are neighbours in the picture.
std::vector<Block> all_blocks(int width, int height);

// Stratified random samples of about `most` pixels of a picture that has more: in blocks, and one by one. The list of
// all blocks or pixels, in that order, is cut into strata of equal length, and one is drawn from each, so that every
// one is in the sample with the same probability. The numbers are the same each time.
std::vector<Block> sample_of_blocks(int width, int height, std::int64_t most);
std::vector<Block> sample_of_pixels(int width, int height, std::int64_t most);

}  // namespace mandelmarch::bench
