// SPDX-License-Identifier: Apache-2.0
// One kernel for all pixels of a job, run by as many warps as a GPU holds at once. Its threads march rays with refill
// (Aila and Laine, "Understanding the efficiency of ray traversal on GPUs", HPG 2009), and a warp shades its hits when
// it has one for each lane. So all lanes have work while a warp marches and while it shades. Needs the words of
// backends/cuda/words.h.
#include "core/models/lanes.h"

// A hit that waits for shading.
struct Waiting {
    int at;  // index in the job's queue
    real t;  // in fast mode before_distance
    real last_t, last_distance, before_t;
    whole steps;
    counter de_calls, iterations;
};

// What a warp keeps in a block's shared memory.
struct WarpMemory {
    Waiting waiting[2 * warp_lanes];
    Ray parked[warp_lanes];  // the rays that the lanes march, during shading
};

FN bool inside_queue(const KernelArguments* job, int at) { return at < places_of(job); }

FN Waiting waiting_hit(Ray ray, int at)
{
    return {at,           canonical != 0 ? ray.before_distance : ray.t,
            ray.last_t,   ray.last_distance,
            ray.before_t, ray.steps,
            ray.de_calls, ray.iterations};
}

FN void shade_waiting(const KernelArguments* job, const Waiting* waiting)
{
    Ray ray = begun(job, place_of(job, waiting->at));
    if (canonical != 0) ray.before_distance = waiting->t;
    if (canonical == 0) ray.t = waiting->t;
    ray.last_t = waiting->last_t;
    ray.last_distance = waiting->last_distance;
    ray.before_t = waiting->before_t;
    ray.steps = 0;
    ray.de_calls = 0;
    ray.iterations = 0;
    Hit hit = stopped(scene_of(job), ray);
    if (canonical != 0) hit = refine(scene_of(job), hit);
    Pixel pixel;
    if (is_hit(hit)) {
        pixel = shaded(job, hit);
    } else {
        pixel = missed(scene_of(job), hit);
    }
    pixel.steps = waiting->steps;
    pixel.de_calls = pixel.de_calls + waiting->de_calls;
    pixel.iterations = pixel.iterations + waiting->iterations;
    put(job, place_of(job, waiting->at).at, pixel);
}

FN void draw_pixels(const KernelArguments* job, WarpMemory* memory)
{
    int at = taken_place(job);
    Ray ray = begun_by_cone(job, place_of(job, inside_queue(job, at) ? at : 0));
    int waiting = 0;
    while (true) {
        const bool running = ballot(inside_queue(job, at)) != 0;
        const Lanes all = ballot(true);
        if (waiting >= lanes_of(all) || !running) {
            memory->parked[lane()] = ray;
            const int ready = waiting < lanes_of(all) ? waiting : lanes_of(all);
            waiting -= ready;
            warp_barrier();
            if (rank(all) < ready) shade_waiting(job, memory->waiting + (waiting + rank(all)));
            warp_barrier();
            ray = memory->parked[lane()];
        }
        if (!running && waiting == 0) return;
        for (int i = 0; i < steps_of_round && inside_queue(job, at) && marching(march_scene_of(job), ray); ++i) {
            ray = march(march_scene_of(job), ray, 1);
        }
        const bool ended = inside_queue(job, at) && !marching(march_scene_of(job), ray);
        const bool hit = ended && has_hit(scene_of(job), ray);
        const Lanes hits = ballot(hit);
        if (hit) memory->waiting[waiting + rank(hits)] = waiting_hit(ray, at);
        if (ended && !hit) {
            put(job, place_of(job, at).at, missed(scene_of(job), stopped(scene_of(job), ray)));
        }
        waiting += lanes_of(hits);
        if (ended) {
            at = taken_place(job);
            if (inside_queue(job, at)) ray = begun_by_cone(job, place_of(job, at));
        }
    }
}

#include "core/kernel/prelude/undefine.h"
