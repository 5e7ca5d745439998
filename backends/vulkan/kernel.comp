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
const int stage_bytes = 32;  // stage_shade stores a pixel's three bytes in one word
const int stage_pack = 64;   // a pass of its own, which packs the words of four pixels into three
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

layout(push_constant) uniform Pass
{
    int first_row;
    int rows;
    int steps;   // max steps of marching; in a pass without marching: max refinements
    int pixels;  // values per plane of the results
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
    if (x >= whole_scene.width || y >= pass.rows) return;
    int pixel = y * whole_scene.width + x;

    Scene scene = whole_scene;
    scene.fractal_whole = fractal_whole;
    scene.canonical = canonical;
    scene.differences = differences;

    Hit hit;
    if ((stages & (stage_begin | stage_march | stage_stop)) != 0) {
        Ray ray;
        if ((stages & stage_begin) != 0) {
            ray = begin(scene, x, pass.first_row + y);
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
            int word = byte_of(done.colour.x) | byte_of(done.colour.y) << 8 | byte_of(done.colour.z) << 16;
            wholes[pixel] = word;
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
