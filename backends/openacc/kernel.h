// SPDX-License-Identifier: Apache-2.0
// The body of every kernel.cpp: two OpenACC kernels over a job's pixels. No include guard: each includes it once.
//
// Registers decide how many threads a GPU can hold, so they are kept low: what a thread needs for a moment only it
// reads from the job, again and again, and what is fixed for the precision and the mode is fixed at compile time.
#include "backends/openacc/kernels.h"

namespace {
namespace kernel {

#include "core/kernel/prelude/scalar.h"
#include "core/kernel/text.h"

#ifdef MM_MODE_fast
constexpr int canonical = 1;
#else
constexpr int canonical = 0;
#endif
// Where a scene's normals come from no tetrahedron.
constexpr int differences = !MM_REAL_IS_FLOAT && canonical == 0;

using Job = mandelmarch::openacc::Job<Scene, MM_REAL>;

// The same value, but the compiler cannot know that: what is computed from it is computed anew.
#ifdef __NVCOMPILER
#define MM_ANEW(value)
#else
#define MM_ANEW(value) asm volatile("" : "+r"(value))
#endif

// The scene, read from memory at this very place.
FN Scene scene_of(const Job* job)
{
    MM_ANEW(job);
    Scene scene = job->scene;
    scene.canonical = canonical;
    scene.differences = scene.differences == 2 ? 2 : differences;
    return scene;
}

// The same for marching, which in exact mode does not ask where normals come from.
FN Scene march_scene_of(const Job* job)
{
    Scene scene = scene_of(job);
    if (canonical == 0) scene.differences = differences;
    return scene;
}

// A thread's pixel.
struct Place {
    bool inside;  // of the job
    int x;
    int y;       // from the job's first row
    int at;      // in a plane
    int pixels;  // of a plane
};

FN Place place_of(const Job* job, int thread)
{
    using mandelmarch::openacc::warp_height;
    using mandelmarch::openacc::warp_width;
    MM_ANEW(job);
    MM_ANEW(thread);
    const int width = job->scene.width;
    const int columns = (width + warp_width - 1) / warp_width;
    const int warp = thread / (warp_width * warp_height);
    const int lane = thread % (warp_width * warp_height);
    Place place;
    place.x = warp % columns * warp_width + lane % warp_width;
    place.y = warp / columns * warp_height + lane / warp_width;
    place.inside = place.x < width && place.y < job->rows;
    place.at = place.y * width + place.x;
    place.pixels = width * job->rows;
    return place;
}

FN Ray begun(const Job* job, Place place)
{
    return begin(scene_of(job), real(place.x), real(job->first_row + place.y));
}

FN void march_pixel(const Job* job, int thread)
{
    Place place = place_of(job, thread);
    if (!place.inside) return;
    Ray ray = begun(job, place);
    while (marching(march_scene_of(job), ray)) ray = march(march_scene_of(job), ray, 1);
    place = place_of(job, thread);
    // The plain schedule asks for t, refinement for the estimate before the hit.
    job->reals[place.at] = canonical != 0 ? ray.before_distance : ray.t;
    job->reals[place.at + place.pixels] = ray.last_t;
    job->reals[place.at + 2 * place.pixels] = ray.last_distance;
    job->reals[place.at + 3 * place.pixels] = ray.before_t;
    job->wholes[place.at] = ray.steps;
    job->wholes[place.at + place.pixels] = ray.estimates;
    job->wholes[place.at + 2 * place.pixels] = ray.iterations;
}

FN void shade_pixel(const Job* job, int thread)
{
    Place place = place_of(job, thread);
    if (!place.inside) return;
    Ray ray = begun(job, place);
    if (canonical != 0) ray.before_distance = job->reals[place.at];
    if (canonical == 0) ray.t = job->reals[place.at];
    ray.last_t = job->reals[place.at + place.pixels];
    ray.last_distance = job->reals[place.at + 2 * place.pixels];
    ray.before_t = job->reals[place.at + 3 * place.pixels];
    ray.steps = job->wholes[place.at];
    ray.estimates = job->wholes[place.at + place.pixels];
    ray.iterations = job->wholes[place.at + 2 * place.pixels];
    Hit hit = stopped(scene_of(job), ray);
    if (canonical != 0) hit = refine(scene_of(job), hit);
    Pixel pixel = shade(scene_of(job), hit);
    place = place_of(job, thread);
    job->reals[place.at] = pixel.colour.x;
    job->reals[place.at + place.pixels] = pixel.colour.y;
    job->reals[place.at + 2 * place.pixels] = pixel.colour.z;
    job->reals[place.at + 3 * place.pixels] = pixel.depth;
    job->wholes[place.at] = pixel.steps;
    job->wholes[place.at + place.pixels] = pixel.estimates;
    job->wholes[place.at + 2 * place.pixels] = pixel.iterations;
}

#include "core/kernel/prelude/undefine.h"

}  // namespace kernel
}  // namespace

using mandelmarch::openacc::block_threads;

extern "C" {

void MM_MARCH(const void* at, int blocks);
void MM_SHADE(const void* at, int blocks);

void MM_MARCH(const void* at, int blocks)
{
    const auto* job = static_cast<const kernel::Job*>(at);
#pragma acc parallel loop gang vector num_gangs(blocks) vector_length(block_threads) deviceptr(job)
    for (int thread = 0; thread < blocks * block_threads; ++thread) kernel::march_pixel(job, thread);
}

void MM_SHADE(const void* at, int blocks)
{
    const auto* job = static_cast<const kernel::Job*>(at);
#pragma acc parallel loop gang vector num_gangs(blocks) vector_length(block_threads) deviceptr(job)
    for (int thread = 0; thread < blocks * block_threads; ++thread) kernel::shade_pixel(job, thread);
}

}  // extern "C"
