// SPDX-License-Identifier: Apache-2.0
// Random samples of a picture's pixels: single pixels, or square patches of neighbouring pixels, like those that
// vectors and warps render.
#pragma once

#include <cstdint>
#include <vector>

namespace mandelmarch::bench {

inline constexpr int block_side = 16;  // pixels

// A square patch of pixels. Pixels outside the picture do not belong to it.
struct Block {
    int column = 0, row = 0;  // lowest column and row
    int side = block_side;    // a power of two
};

// Calls each(column, row) for the patch's pixels inside the picture, along Morton's curve: each aligned group of 2^n
// consecutive pixels fills a rectangle with as many columns as rows, or twice as many.
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

// Returns all patches of a picture, along Morton's curve, so that neighbours in the list lie close together in the
// picture.
std::vector<Block> all_blocks(int width, int height);

// Return a stratified random sample of about `most` pixels: sample_of_blocks() as whole patches, sample_of_pixels() as
// patches of one pixel. If the picture does not have more pixels, they return all of them. The list of all patches, or
// of all pixels, along Morton's curve is divided into strata of equal length. One element of each stratum is chosen at
// random, so that every element has the same probability. The sample is reproducible.
std::vector<Block> sample_of_blocks(int width, int height, std::int64_t most);
std::vector<Block> sample_of_pixels(int width, int height, std::int64_t most);

}  // namespace mandelmarch::bench
