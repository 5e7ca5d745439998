// SPDX-License-Identifier: Apache-2.0
// Strips of a lattice's cells, and the blocks of pixels that fill a vector.

// MM_STRIP is the height of a strip, in cells. MM_WIDTH and MM_HEIGHT are the sides of a block of MM_LANES cells, which
// is as square as possible.
#define MM_STRIP 16
#if MM_LANES == 32
#define MM_WIDTH 8
#elif MM_LANES >= 8
#define MM_WIDTH 4
#else
#define MM_WIDTH 2
#endif
#define MM_HEIGHT (MM_LANES / MM_WIDTH)

// A range of a lattice's cells in a band of `rows` rows of pixels. The band's lowest row is the picture's row
// `first_row`.
struct Strip {
    int left;
    int right;
    int bottom;
    int top;
    int first_row;
    int rows;
};

// Stores the pixels of the first `size` lanes. `at` contains each pixel's index in a plane; -1: not stored.
FN void put_lanes(Target target, const int* at, int size, Pixel pixel)
{
    if (target.bytes_alone != 0) {
        union Wholes bytes = {bytes_of(pixel.colour)};
        for (int lane = 0; lane < size; ++lane) {
            if (at[lane] >= 0) put_bytes(target, at[lane], (int)bytes.of[lane]);
        }
        return;
    }
    union Reals red = {pixel.colour.x};
    union Reals green = {pixel.colour.y};
    union Reals blue = {pixel.colour.z};
    union Reals depth = {pixel.depth};
    union Wholes steps = {pixel.steps};
    union Wholes de_calls = {pixel.de_calls};
    union Wholes iterations = {pixel.iterations};
    for (int lane = 0; lane < size; ++lane) {
        if (at[lane] < 0) continue;
        put(target, at[lane], red.of[lane], green.of[lane], blue.of[lane], depth.of[lane], (int)steps.of[lane],
            (int)de_calls.of[lane], (int)iterations.of[lane]);
    }
}

// A pixel of each cell of a block, at least one of which is in the strip. x and y are the pixels' columns and rows in
// the band. `at` has their indices in a plane, and -1 for pixels outside the strip or the band.
struct Block {
    int x[MM_LANES];
    int y[MM_LANES];
    int at[MM_LANES];
};

FN int cell_side(Starts starts) { return starts.before > 0 ? starts.before : starts.apart; }

// Returns the pixels at a place of the cells from (x, y) on. A first lattice has the place 0 only, later ones have 1 to
// 3: to the right of the cell's lower left pixel, above it, and above and to the right.
FN Block block_at(Strip strip, Starts starts, int x, int y, int place, int width)
{
    int side = cell_side(starts);
    Block block;
    for (int lane = 0; lane < MM_LANES; ++lane) {
        int column = x + lane % MM_WIDTH;
        int row = y + lane / MM_WIDTH;
        block.x[lane] = column * side + place % 2 * starts.apart;
        block.y[lane] = row * side + place / 2 * starts.apart;
        bool inside = column < strip.right && row < strip.top && block.x[lane] < width && block.y[lane] < strip.rows;
        block.at[lane] = inside ? block.y[lane] * width + block.x[lane] : -1;
    }
    return block;
}
