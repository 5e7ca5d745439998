// SPDX-License-Identifier: Apache-2.0
// The kernel as a compute shader. An invocation processes one pixel. A specialization constant selects which stages of
// the kernel a pass executes.
#version 460
#include "core/kernel/prelude/glsl.h"
#include "core/kernel/text.h"
#define MM_TRUNCATED(x) int(x)
#include "core/kernel/bytes.h"

// A work group covers a square of pixels, because neighbouring rays end after about the same number of steps.
const int side = 8;
layout(local_size_x = side * side) in;

// The stages of a pixel, in order; `stages` contains those that this pipeline executes. Between two pipelines a pixel
// is stored as a Ray before stage_stop, and as a Hit after it.
const int stage_begin = 1;
const int stage_march = 2;
const int stage_stop = 4;
const int stage_refine = 8;
const int stage_shade = 16;
const int stage_bytes = 32;   // stage_shade stores a pixel's three bytes in one word
const int stage_pack = 64;    // a pass of its own, which packs the words of four pixels into three
const int stage_cones = 128;  // a pass of its own, which marches the cone of a tile
layout(constant_id = 0) const int stages = 31;
// Scene parameters that rarely change are constants of the pipeline. This removes branches, which are expensive on some
// devices.
layout(constant_id = 1) const int fractal_whole = 0;
layout(constant_id = 2) const int canonical = 0;
layout(constant_id = 3) const int differences = 0;

layout(std430, binding = 0) readonly buffer SceneBuffer { Scene whole_scene; };
layout(std430, binding = 1) buffer RayBuffer { Ray rays[]; };
layout(std430, binding = 1) buffer HitBuffer { Hit hits[]; };  // the same memory
layout(std430, binding = 2) writeonly buffer RealBuffer { real reals[]; };
layout(std430, binding = 2) writeonly buffer PackedBuffer { int packed_bytes[]; };  // the same memory
layout(std430, binding = 3) buffer WholeBuffer { int wholes[]; };
layout(std430, binding = 4) writeonly buffer FlagBuffer
{
    int still_marching;
    int rays_cut_off;
};

// Of the tiles with cones, first those of the outer level, then those of the inner one: the t at which their rays
// begin, and the DE evaluations and iterations of their cones.
layout(std430, binding = 5) buffer StartBuffer { real starts[]; };
layout(std430, binding = 6) writeonly buffer ConeWorkBuffer { int cone_work[]; };

layout(push_constant) uniform Pass
{
    int first_row;
    int rows;
    int steps;   // max steps of marching; in a pass without marching: max refinements
    int pixels;  // values per plane of the results; in a pass of cones 0 if their work is not needed
    int side;    // of the tiles whose cones have been marched last, in pixels; 0: there are no cones
    int within;  // of the tiles around these; 0: there are none
} pass;

// Returns every second bit of an index below 64, beginning with `bit` 0 or 1: a coordinate of the index's place in
// Morton order.
int every_second(int index, int bit)
{
    int bits = index >> bit;
    return (bits & 1) | ((bits >> 1) & 2) | ((bits >> 2) & 4);
}

// Number of steps given to a ray whose loop the device has cut off. It exceeds every limit, so the ray stops marching.
const int cut_off = 1 << 30;

// Returns `steps`, or cut_off if the device has ended a loop of this invocation early. lavapipe limits the sum of the
// iterations of all loops of an invocation. When the limit is reached, the invocation leaves the current loop,
// continues after it, and gets one iteration in each later loop. This function's loop needs two iterations, so if it
// gets only one, an earlier loop was cut off. Its bounds come from a buffer, so that no compiler removes the loop.
int steps_or_cut_off(int steps)
{
    int round = whole_scene.max_steps - 2;
    while (round < whole_scene.max_steps) round = round + 1;
    if (round == whole_scene.max_steps) return steps;
    rays_cut_off = 1;
    return cut_off;
}

int tiles_along(int size, int tile) { return (size + tile - 1) / tile; }

int tiles_of(int tile) { return tile == 0 ? 0 : tiles_along(whole_scene.width, tile) * tiles_along(pass.rows, tile); }

// Returns the index in `starts` of the tile that contains the pixel (x, y) of the band; `first`: index of the first
// tile.
int tile_at(int x, int y, int tile, int first)
{
    return first + y / tile * tiles_along(whole_scene.width, tile) + x / tile;
}

// Marches the cone of the tile in column x and row y of tiles.
void march_tile(Scene scene, int x, int y)
{
    x *= pass.side;
    y *= pass.side;
    if (x >= scene.width || y >= pass.rows) return;
    Ray cone = begin_cone(scene, real(x), real(pass.first_row + y), real(pass.side));
    if (pass.within > 0) cone.t = larger(starts[tile_at(x, y, pass.within, 0)], cone.t);
    cone = march_cone(scene, cone, cone_width(scene, real(pass.side)));
    int at = tile_at(x, y, pass.side, tiles_of(pass.within));
    cone.steps = steps_or_cut_off(cone.steps);
    starts[at] = cone_end(scene, cone);
    if (pass.pixels == 0) return;
    cone_work[2 * at] = cone.de_calls;
    cone_work[2 * at + 1] = cone.iterations;
}

// Packs the bytes of four pixels, of which the first has the index 4 * at, into three words.
void pack(int at)
{
    if (4 * at >= whole_scene.width * pass.rows) return;
    int a = wholes[4 * at];
    int b = wholes[4 * at + 1];
    int c = wholes[4 * at + 2];
    int d = wholes[4 * at + 3];
    packed_bytes[3 * at] = a | b << 24;
    packed_bytes[3 * at + 1] = b >> 8 | c << 16;
    packed_bytes[3 * at + 2] = c >> 16 | d << 8;
}

void main()
{
    int at = int(gl_LocalInvocationIndex);
    if (stages == stage_pack) {
        pack(int(gl_WorkGroupID.x) * side * side + at);
        return;
    }
    int x = int(gl_WorkGroupID.x) * side + every_second(at, 0);
    int y = int(gl_WorkGroupID.y) * side + every_second(at, 1);
    Scene scene = whole_scene;
    scene.fractal_whole = fractal_whole;
    scene.canonical = canonical;
    scene.differences = differences;
    if (stages == stage_cones) {
        march_tile(scene, x, y);
        return;
    }
    if (x >= whole_scene.width || y >= pass.rows) return;
    int pixel = y * whole_scene.width + x;

    Hit hit;
    if ((stages & (stage_begin | stage_march | stage_stop)) != 0) {
        Ray ray;
        if ((stages & stage_begin) != 0) {
            ray = begin(scene, x, pass.first_row + y);
            if (pass.side > 0) ray.t = larger(starts[tile_at(x, y, pass.side, tiles_of(pass.within))], ray.t);
        } else {
            ray = rays[pixel];
        }
        if ((stages & stage_march) != 0) {
            ray = march(scene, ray, pass.steps);
            if (marching(scene, ray)) still_marching = 1;
        }
        if ((stages & stage_stop) == 0) {
            ray.steps = steps_or_cut_off(ray.steps);
            rays[pixel] = ray;
            return;
        }
        hit = stopped(scene, ray);
    } else {
        hit = hits[pixel];
    }
    if ((stages & stage_refine) != 0) {
        if ((stages & stage_march) != 0) {
            hit = refine(scene, hit);
        } else {
            hit = refine_by(scene, hit, pass.steps);
        }
    }
    if ((stages & stage_shade) != 0) {
        Pixel done = shade(scene, hit);
        if ((stages & stage_bytes) != 0) {
            wholes[pixel] = bytes_of(done.colour);
            steps_or_cut_off(0);
            return;
        }
        reals[pixel] = done.colour.x;
        reals[pixel + pass.pixels] = done.colour.y;
        reals[pixel + 2 * pass.pixels] = done.colour.z;
        reals[pixel + 3 * pass.pixels] = done.depth;
        wholes[pixel] = steps_or_cut_off(done.steps);
        wholes[pixel + pass.pixels] = done.de_calls;
        wholes[pixel + 2 * pass.pixels] = done.iterations;
    } else {
        hit.steps = steps_or_cut_off(hit.steps);
        hits[pixel] = hit;
    }
}
