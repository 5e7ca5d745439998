// SPDX-License-Identifier: Apache-2.0
// The kernel of the OpenCL backend: a work item draws MM_LANES pixels, a rectangle of pixels as square as they allow.
#include "core/kernel/prelude/opencl.h"
#include "core/kernel/text.h"
#define MM_TRUNCATED(x) ((int)(x))
#include "core/kernel/bytes.h"

#if MM_LANES == 16
#define MM_WIDTH 4
#elif MM_LANES == 8
#define MM_WIDTH 4
#elif MM_LANES == 1
#define MM_WIDTH 1
#else
#define MM_WIDTH 2
#endif
#define MM_HEIGHT (MM_LANES / MM_WIDTH)

// A vector and its lanes.
union Reals {
    real all;
    scalar of[MM_LANES];
};

union Wholes {
    whole all;
    scalar_whole of[MM_LANES];
};

// Rows [first_row, first_row + rows) of the picture: three bytes a pixel if `bytes_alone`, else the planes of
// core/image/image.h, `pixels` values each.
__kernel void draw_band(__constant Scene* scene, int first_row, int rows, long pixels, __global scalar* reals,
                        __global int* wholes, __global uchar* bytes, int bytes_alone)
{
    int left = (int)get_global_id(0) * MM_WIDTH;
    int bottom = (int)get_global_id(1) * MM_HEIGHT;
    int width = scene->width;
    if (left >= width || bottom >= rows) return;
    // Lanes beyond the edge draw the last pixel once more, and are not stored.
    union Reals i;
    union Reals j;
    for (int lane = 0; lane < MM_LANES; ++lane) {
        i.of[lane] = (scalar)min(left + lane % MM_WIDTH, width - 1);
        j.of[lane] = (scalar)(first_row + min(bottom + lane / MM_WIDTH, rows - 1));
    }
    Pixel pixel = draw(*scene, i.all, j.all);
    union Reals red = {pixel.colour.x};
    union Reals green = {pixel.colour.y};
    union Reals blue = {pixel.colour.z};
    union Reals depth = {pixel.depth};
    union Wholes steps = {pixel.steps};
    union Wholes estimates = {pixel.estimates};
    union Wholes iterations = {pixel.iterations};
    for (int lane = 0; lane < MM_LANES; ++lane) {
        int x = left + lane % MM_WIDTH;
        int y = bottom + lane / MM_WIDTH;
        if (x >= width || y >= rows) continue;
        long at = (long)y * width + x;
        if (bytes_alone != 0) {
            vstore3((uchar3)((uchar)byte_of(red.of[lane]), (uchar)byte_of(green.of[lane]),
                             (uchar)byte_of(blue.of[lane])),
                    at, bytes);
            continue;
        }
        reals[at] = red.of[lane];
        reals[pixels + at] = green.of[lane];
        reals[2 * pixels + at] = blue.of[lane];
        reals[3 * pixels + at] = depth.of[lane];
        wholes[at] = (int)steps.of[lane];
        wholes[pixels + at] = (int)estimates.of[lane];
        wholes[2 * pixels + at] = (int)iterations.of[lane];
    }
}
