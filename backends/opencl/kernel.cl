// SPDX-License-Identifier: Apache-2.0
// The kernel of the OpenCL backend: a work item renders a pixel, or with vectors a strip of pixels.
#include "core/kernel/prelude/opencl.h"
#include "core/kernel/text.h"
#define MM_TRUNCATED MM_TO_INT
#include "core/kernel/bytes.h"

// Destination of finished pixels. If `bytes_alone` is set, a pixel is three bytes; otherwise it is one value in each
// plane. The planes are those of core/image/image.h, with `pixels` values each.
struct Target {
    __global scalar* reals;
    __global int* wholes;
    __global uchar* bytes;
    long pixels;
    int bytes_alone;
};

// Stores a result of bytes_of().
FN void put_bytes(Target target, long at, int bytes)
{
    vstore3((uchar3)((uchar)bytes, (uchar)(bytes >> 8), (uchar)(bytes >> 16)), at, target.bytes);
}

FN void put(Target target, long at, scalar red, scalar green, scalar blue, scalar depth, int steps, int de_calls,
            int iterations)
{
    target.reals[at] = red;
    target.reals[target.pixels + at] = green;
    target.reals[2 * target.pixels + at] = blue;
    target.reals[3 * target.pixels + at] = depth;
    target.wholes[at] = steps;
    target.wholes[target.pixels + at] = de_calls;
    target.wholes[2 * target.pixels + at] = iterations;
}

// Access to a vector as a whole and by lane.
union Reals {
    real all;
    scalar of[MM_LANES];
};

union Wholes {
    whole all;
    scalar_whole of[MM_LANES];
};

FN int tiles_along(int pixels, int side) { return (pixels + side - 1) / side; }

// Where the rays of a band's lattice begin (core/render/lattice.h).
struct Starts {
    __global const scalar* tiles;  // by tile: the t at which its cone has ended
    int log2_side;                 // of the tiles' side in pixels; negative: there are no cones
    int columns;                   // of tiles
    __global scalar* depths;       // that pixels in even columns and rows pass on, at half the pixel's index
    int before;                    // the lattice
    int apart;
};

// Returns the t at which the cone of a pixel's tile has ended; 0: there are no cones. y: the row in the band.
FN scalar tile_start(Starts starts, int x, int y)
{
    if (starts.log2_side < 0) return 0;
    return starts.tiles[(y >> starts.log2_side) * starts.columns + (x >> starts.log2_side)];
}

#if MM_LANES > 1
#include "backends/opencl/strip.cl"
#include "backends/opencl/refill.cl"
#endif

// Marches the cones of a band's tiles. A work item marches those of MM_LANES tiles, counted row by row. Stores the t at
// which their rays begin, and their DE evaluations and iterations.
#if !MM_EXACT
__kernel void march_cones(__constant Scene* scene, int first_row, int rows, int side, __global scalar* starts,
                          __global int* work)
{
    int columns = tiles_along(scene->width, side);
    int tiles = columns * tiles_along(rows, side);
    int first = (int)get_global_id(0) * MM_LANES;
    if (first >= tiles) return;
    union Reals i;
    union Reals j;
    for (int lane = 0; lane < MM_LANES; ++lane) {
        int tile = min(first + lane, tiles - 1);
        i.of[lane] = (scalar)(tile % columns * side);
        j.of[lane] = (scalar)(first_row + tile / columns * side);
    }
    Ray cone = march_cone(*scene, begin_cone(*scene, i.all, j.all, side), cone_width(*scene, side));
    union Reals start = {cone_end(*scene, cone)};
    union Wholes de_calls = {cone.de_calls};
    union Wholes iterations = {cone.iterations};
    for (int lane = 0; lane < min(MM_LANES, tiles - first); ++lane) {
        starts[first + lane] = start.of[lane];
        work[2 * (first + lane)] = (int)de_calls.of[lane];
        work[2 * (first + lane) + 1] = (int)iterations.of[lane];
    }
}
#endif

// Renders the pixels of a lattice in rows [first_row, first_row + rows) of the picture. With vectors, a work item
// renders a strip of `width` x MM_STRIP cells of the lattice; `width` is a multiple of MM_WIDTH. Without, the lattice
// is {0, 1}.
__kernel void draw_band(__constant Scene* scene, int first_row, int rows, long pixels, __global scalar* reals,
                        __global int* wholes, __global uchar* bytes, int bytes_alone, int width,
                        __global const scalar* tiles, int log2_side, __global scalar* depths, int before, int apart)
{
    Target target = {reals, wholes, bytes, pixels, bytes_alone};
    int columns_of_tiles = log2_side < 0 ? 0 : tiles_along(scene->width, 1 << log2_side);
    Starts starts = {tiles, log2_side, columns_of_tiles, depths, before, apart};
    int x = (int)get_global_id(0);
    int y = (int)get_global_id(1);
#if MM_LANES == 1
    if (x >= scene->width || y >= rows) return;
    Ray ray = begin(*scene, x, first_row + y);
    ray.t = larger(tile_start(starts, x, y), ray.t);
    Pixel pixel = drawn(*scene, march(*scene, ray, scene->max_steps));
    long at = (long)y * scene->width + x;
    if (bytes_alone != 0) {
        put_bytes(target, at, bytes_of(pixel.colour));
    } else {
        put(target, at, pixel.colour.x, pixel.colour.y, pixel.colour.z, pixel.depth, pixel.steps, pixel.de_calls,
            pixel.iterations);
    }
#else
    // PoCL gives each thread a range of consecutive work groups; on two cores, the first range is half of all groups.
    // For ranges of about equal cost, consecutive rows of groups render strips that are far apart. The number of rows
    // is a power of two, so that multiplying by an odd number permutes them, even if the product wraps around.
    uint lines_of_groups = (uint)get_global_size(1);
    y = (int)((uint)y * (lines_of_groups * 5 / 8 | 1) % lines_of_groups);
    int cell = cell_side(starts);
    int columns = tiles_along(scene->width, cell);
    int lines = tiles_along(rows, cell);
    Strip strip = {x * width, min(x * width + width, columns), y * MM_STRIP, min(y * MM_STRIP + MM_STRIP, lines),
                   first_row, rows};
    if (strip.left >= strip.right || strip.bottom >= strip.top) return;
    draw_refilling(scene, strip, starts, target);
#endif
}
