// SPDX-License-Identifier: Apache-2.0
// Renders a strip of pixels in vectors, block by block.

// MM_STRIP is the height of a strip, in pixels. MM_WIDTH and MM_HEIGHT are the sides of a block of MM_LANES pixels,
// which is as square as possible.
#define MM_STRIP 16
#if MM_LANES == 32
#define MM_WIDTH 8
#elif MM_LANES >= 8
#define MM_WIDTH 4
#else
#define MM_WIDTH 2
#endif
#define MM_HEIGHT (MM_LANES / MM_WIDTH)

// A range of pixels in a band. Rows are counted from the band's lowest row, which is the picture's row `first_row`.
struct Strip {
    int left;
    int right;
    int bottom;
    int top;
    int first_row;
};

// Access to a vector as a whole and by lane.
union Reals {
    real all;
    scalar of[MM_LANES];
};

union Wholes {
    whole all;
    scalar_whole of[MM_LANES];
};

// Stores the pixels of the first `size` lanes. `at` contains each pixel's index in a plane; -1: not stored.
FN void put_lanes(Target target, const int* at, int size, Pixel pixel)
{
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

// A block of pixels, at least one of which is in the strip. i and j are the pixels' columns and rows in the picture.
// `at` has their indices in a plane, and -1 for pixels outside the strip.
struct Block {
    union Reals i;
    union Reals j;
    int at[MM_LANES];
};

FN Block block_at(Strip strip, int x, int y, int width)
{
    Block block;
    for (int lane = 0; lane < MM_LANES; ++lane) {
        int column = x + lane % MM_WIDTH;
        int row = y + lane / MM_WIDTH;
        block.i.of[lane] = (scalar)min(column, strip.right - 1);
        block.j.of[lane] = (scalar)(strip.first_row + min(row, strip.top - 1));
        block.at[lane] = column < strip.right && row < strip.top ? row * width + column : -1;
    }
    return block;
}

FN void draw_by_blocks(__constant Scene* scene, Strip strip, Target target)
{
    for (int x = strip.left; x < strip.right; x += MM_WIDTH) {
        for (int y = strip.bottom; y < strip.top; y += MM_HEIGHT) {
            Block block = block_at(strip, x, y, scene->width);
            put_lanes(target, block.at, MM_LANES, draw(*scene, block.i.all, block.j.all));
        }
    }
}
