// SPDX-License-Identifier: Apache-2.0
// The kernel of the OpenCL backend: a work item renders a pixel, or with vectors a strip of pixels.
#include "core/kernel/prelude/opencl.h"
#include "core/kernel/text.h"
#define MM_TRUNCATED(x) ((int)(x))
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

FN void put(Target target, long at, scalar red, scalar green, scalar blue, scalar depth, int steps, int de_calls,
            int iterations)
{
    if (target.bytes_alone != 0) {
        uchar3 bytes = (uchar3)((uchar)byte_of(red), (uchar)byte_of(green), (uchar)byte_of(blue));
        vstore3(bytes, at, target.bytes);
        return;
    }
    target.reals[at] = red;
    target.reals[target.pixels + at] = green;
    target.reals[2 * target.pixels + at] = blue;
    target.reals[3 * target.pixels + at] = depth;
    target.wholes[at] = steps;
    target.wholes[target.pixels + at] = de_calls;
    target.wholes[2 * target.pixels + at] = iterations;
}

#if MM_LANES > 1
#include "backends/opencl/strip.cl"
#ifdef MM_REFILL_LANES
#include "backends/opencl/refill.cl"
#endif
#endif

// Renders rows [first_row, first_row + rows) of the picture. With vectors, a work item renders a strip of
// `width` x MM_STRIP pixels; `width` is a multiple of MM_WIDTH.
__kernel void draw_band(__constant Scene* scene, int first_row, int rows, long pixels, __global scalar* reals,
                        __global int* wholes, __global uchar* bytes, int bytes_alone, int width)
{
    Target target = {reals, wholes, bytes, pixels, bytes_alone};
    int x = (int)get_global_id(0);
    int y = (int)get_global_id(1);
#if MM_LANES == 1
    if (x >= scene->width || y >= rows) return;
    Pixel pixel = draw(*scene, x, first_row + y);
    put(target, (long)y * scene->width + x, pixel.colour.x, pixel.colour.y, pixel.colour.z, pixel.depth, pixel.steps,
        pixel.de_calls, pixel.iterations);
#else
    Strip strip = {x * width, min(x * width + width, scene->width), y * MM_STRIP, min(y * MM_STRIP + MM_STRIP, rows),
                   first_row};
    if (strip.left >= strip.right || strip.bottom >= strip.top) return;
#ifdef MM_REFILL_LANES
    draw_refilling(scene, strip, target);
#else
    draw_by_blocks(scene, strip, target);
#endif
#endif
}
