// SPDX-License-Identifier: Apache-2.0
// What the warps of a GPU do for a job, in models without operations on the lanes of a warp. If rays begin at the ends
// of cones, warps march the cones. Then they render pixels until the job's queue is empty (persistent threads: Aila and
// Laine, "Understanding the efficiency of ray traversal on GPUs", HPG 2009). A warp takes a chunk of pixels, marches
// their rays with refill, and shades their hits. So all lanes have work while it marches, and again while it shades.
#include "core/models/lanes.h"

// Stores a stopped ray in its pixel's planes, for shade_chunk().
FN void put_ray(const KernelArguments* job, Place place, Ray ray)
{
    // The first plane holds the value that the hit is computed from: t in exact mode, before_distance in fast mode, for
    // refinement.
    job->reals[place.at] = canonical != 0 ? ray.before_distance : ray.t;
    job->reals[place.at + place.pixels] = ray.last_t;
    job->reals[place.at + 2 * place.pixels] = ray.last_distance;
    job->reals[place.at + 3 * place.pixels] = ray.before_t;
    job->wholes[place.at] = ray.steps;
    job->wholes[place.at + place.pixels] = ray.de_calls;
    job->wholes[place.at + 2 * place.pixels] = ray.iterations;
}

// Marches the cones of the tiles thread, thread + threads, ...
FN void march_tiles(const KernelArguments* job, int thread, int threads)
{
    for (int tile = thread; tile < tile_columns(job) * tiles_in(job, job->rows); tile += threads) march_tile(job, tile);
}

// Takes the next chunk of a queue of which `taken` have been taken. Returns the index of its first pixel; places_of()
// or more if there is none.
FN int taken_chunk(const KernelArguments* job, int* taken)
{
    // An empty queue keeps its number, so that warps may ask it in any number of launches.
    if (job->chunk * __atomic_load_n(taken, __ATOMIC_RELAXED) >= places_of(job)) return places_of(job);
    return job->chunk * __atomic_fetch_add(taken, 1, __ATOMIC_RELAXED);
}

FN int end_of_chunk(const KernelArguments* job, int first)
{
    const int end = first + job->chunk;
    return end < places_of(job) ? end : places_of(job);
}

// Takes the next pixel of a chunk of which `marched` have been taken. Returns `end` or more if there is none.
FN int taken_of_chunk(const KernelArguments* job, int first, int end, int* marched)
{
    int at = 0;
    do at = first + __atomic_fetch_add(marched, 1, __ATOMIC_RELAXED);
    while (at < end && !place_of(job, at).inside);
    return at;
}

// Marches rays of a chunk until none is left, as the other lanes do at the same time. `marched`: 0 before the first
// lane begins. Stores the stopped rays in the planes.
FN void march_chunk(const KernelArguments* job, int first, int* marched)
{
    const int end = end_of_chunk(job, first);
    int at = taken_of_chunk(job, first, end, marched);
    if (at >= end) return;
    Ray ray = begun_by_cone(job, place_of(job, at));
    while (at < end) {
        for (int i = 0; i < steps_of_round && marching(march_scene_of(job), ray); ++i) {
            ray = march(march_scene_of(job), ray, 1);
        }
        if (!marching(march_scene_of(job), ray)) {
            put_ray(job, place_of(job, at), ray);
            at = taken_of_chunk(job, first, end, marched);
            if (at < end) ray = begun_by_cone(job, place_of(job, at));
        }
    }
}

// Shades the pixels of a chunk that are one lane's, after all lanes have ended march_chunk(). Sets `marched` to 0.
FN void shade_chunk(const KernelArguments* job, int first, int* marched, int lane)
{
    if (lane == 0) *marched = 0;
    for (int at = first + lane; at < end_of_chunk(job, first); at += mandelmarch::job::warp_threads) {
        Place place = place_of(job, at);
        if (!place.inside) continue;
        Ray ray = begun(job, place);
        if (canonical != 0) ray.before_distance = job->reals[place.at];
        if (canonical == 0) ray.t = job->reals[place.at];
        ray.last_t = job->reals[place.at + place.pixels];
        ray.last_distance = job->reals[place.at + 2 * place.pixels];
        ray.before_t = job->reals[place.at + 3 * place.pixels];
        ray.steps = job->wholes[place.at];
        ray.de_calls = job->wholes[place.at + place.pixels];
        ray.iterations = job->wholes[place.at + 2 * place.pixels];
        Hit hit = stopped(scene_of(job), ray);
        if (canonical != 0) hit = refine(scene_of(job), hit);
        Pixel pixel;
        if (is_hit(hit)) {
            pixel = shaded(job, hit);
        } else {
            pixel = missed(scene_of(job), hit);
        }
        put(job, place_of(job, at).at, pixel);
    }
}

#include "core/kernel/prelude/undefine.h"
