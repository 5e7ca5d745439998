// SPDX-License-Identifier: Apache-2.0
// Renders a strip of pixels with refill: a lane whose ray has ended takes the strip's next ray (persistent threads:
// Aila and Laine, "Understanding the efficiency of ray traversal on GPUs", HPG 2009). Used for fractals whose lanes
// would otherwise wait long for the slowest ray of a vector. Ended rays are collected until they fill a vector, which
// is then shaded. A pixel's result does not depend on the lane that computes it.

// While the strip has rays left, idle lanes are refilled as soon as fewer than MM_BUSY lanes are marching.
#define MM_BUSY (MM_LANES - MM_LANES / 8)

// Returns the mask as bits: bit n is set if lane n is active.
FN uint bits_of(mask on)
{
    union Wholes lanes = {on};
    uint bits = 0;
    for (int lane = 0; lane < MM_LANES; ++lane) bits += (uint)lanes.of[lane] & (1u << lane);
    return bits;
}

FN int lowest_of(uint bits) { return (int)popcount((bits & -bits) - 1); }

// The rays of the strip's current block, and the position of the next block.
struct Queue {
    int x;
    int y;
    uint waiting;  // bit n: no lane has taken the block's ray n yet
    int at[MM_LANES];
    union Reals reals[5];  // direction, end, t
};

// The rays in the lanes: one vector for each field of a Ray.
struct Lanes {
    union Reals reals[9];
    union Wholes wholes[3];
    int at[MM_LANES];  // indices of the rays' pixels in a plane
    uint taken;        // bit n: lane n has a ray
};

// The fields of ended rays (Hit) that wait for shading.
struct Ended {
    scalar reals[9][2 * MM_LANES];
    scalar_whole wholes[3][2 * MM_LANES];
    int at[2 * MM_LANES];
    int size;
};

FN void begin_block(__constant Scene* scene, Strip strip, Queue* queue)
{
    Block block = block_at(strip, queue->x, queue->y, scene->width);
    queue->waiting = 0;
    for (int lane = 0; lane < MM_LANES; ++lane) {
        queue->at[lane] = block.at[lane];
        if (block.at[lane] >= 0) queue->waiting |= 1u << lane;
    }
    Ray ray = begin(*scene, block.i.all, block.j.all);
    queue->reals[0].all = ray.direction.x;
    queue->reals[1].all = ray.direction.y;
    queue->reals[2].all = ray.direction.z;
    queue->reals[3].all = ray.end;
    queue->reals[4].all = ray.t;
    queue->y += MM_HEIGHT;
    if (queue->y >= strip.top) {
        queue->y = strip.bottom;
        queue->x += MM_WIDTH;
    }
}

FN bool rays_wait(Strip strip, const Queue* queue) { return queue->waiting != 0 || queue->x < strip.right; }

// Starts a ray of the strip in each free lane, while the strip has rays left. Sets the same values as begin_along().
FN void take(__constant Scene* scene, Strip strip, Queue* queue, Lanes* lanes, uint free)
{
    for (; free != 0 && rays_wait(strip, queue); free &= free - 1) {
        int lane = lowest_of(free);
        if (queue->waiting == 0) begin_block(scene, strip, queue);
        int from = lowest_of(queue->waiting);
        queue->waiting &= queue->waiting - 1;
        for (int field = 0; field < 5; ++field) lanes->reals[field].of[lane] = queue->reals[field].of[from];
        lanes->reals[5].of[lane] = 0;
        lanes->reals[6].of[lane] = scene->end;
        lanes->reals[7].of[lane] = 0;
        lanes->reals[8].of[lane] = scene->end;
        for (int field = 0; field < 3; ++field) lanes->wholes[field].of[lane] = 0;
        lanes->at[lane] = queue->at[from];
        lanes->taken |= 1u << lane;
    }
}

FN Ray ray_of(const Lanes* lanes)
{
    Ray ray;
    ray.direction = vec3(lanes->reals[0].all, lanes->reals[1].all, lanes->reals[2].all);
    ray.end = lanes->reals[3].all;
    ray.t = lanes->reals[4].all;
    ray.last_t = lanes->reals[5].all;
    ray.last_distance = lanes->reals[6].all;
    ray.before_t = lanes->reals[7].all;
    ray.before_distance = lanes->reals[8].all;
    ray.steps = lanes->wholes[0].all;
    ray.de_calls = lanes->wholes[1].all;
    ray.iterations = lanes->wholes[2].all;
    return ray;
}

FN void keep(Lanes* lanes, Ray ray)
{
    lanes->reals[4].all = ray.t;
    lanes->reals[5].all = ray.last_t;
    lanes->reals[6].all = ray.last_distance;
    lanes->reals[7].all = ray.before_t;
    lanes->reals[8].all = ray.before_distance;
    lanes->wholes[0].all = ray.steps;
    lanes->wholes[1].all = ray.de_calls;
    lanes->wholes[2].all = ray.iterations;
}

// Appends the ended rays of the `done` lanes: hits to the first list, misses to the second.
FN void leave(const Lanes* lanes, uint done, Hit hit, Ended* ended)
{
    union Reals reals[9] = {{hit.direction.x}, {hit.direction.y}, {hit.direction.z}, {hit.state},  {hit.t},
                            {hit.below_t},     {hit.below_f},     {hit.above_t},     {hit.above_f}};
    for (; done != 0; done &= done - 1) {
        int lane = lowest_of(done);
        Ended* list = ended + (reals[3].of[lane] > 0 ? 0 : 1);
        int place = list->size++;
        for (int field = 0; field < 9; ++field) list->reals[field][place] = reals[field].of[lane];
        for (int field = 0; field < 3; ++field) list->wholes[field][place] = lanes->wholes[field].of[lane];
        list->at[place] = lanes->at[lane];
    }
}

#if MM_LANES > 16
FN real reals_at(const scalar* from) { return (real)(vload16(0, from), vload16(1, from)); }
FN whole wholes_at(const scalar_whole* from) { return (whole)(vload16(0, from), vload16(1, from)); }
#else
FN real reals_at(const scalar* from) { return MM_PASTE(vload, MM_LANES)(0, from); }
FN whole wholes_at(const scalar_whole* from) { return MM_PASTE(vload, MM_LANES)(0, from); }
#endif

// Removes up to one vector of rays from the end of a list and shades them.
FN void shade_last(__constant Scene* scene, Ended* ended, Target target)
{
    int size = min(ended->size, MM_LANES);
    ended->size -= size;
    int first = ended->size;
    union Wholes there;
    for (int lane = 0; lane < MM_LANES; ++lane) there.of[lane] = lane < size ? -1 : 0;
    Hit hit;
    hit.direction = vec3(reals_at(ended->reals[0] + first), reals_at(ended->reals[1] + first),
                         reals_at(ended->reals[2] + first));
    hit.state = pick(there.all, reals_at(ended->reals[3] + first), no_hit());
    hit.t = reals_at(ended->reals[4] + first);
    hit.below_t = reals_at(ended->reals[5] + first);
    hit.below_f = reals_at(ended->reals[6] + first);
    hit.above_t = reals_at(ended->reals[7] + first);
    hit.above_f = reals_at(ended->reals[8] + first);
    hit.steps = wholes_at(ended->wholes[0] + first);
    hit.de_calls = wholes_at(ended->wholes[1] + first);
    hit.iterations = wholes_at(ended->wholes[2] + first);
    if (scene->canonical != 0) hit = refine(*scene, hit);
    put_lanes(target, ended->at + first, size, shade(*scene, hit));
}

FN void draw_refilling(__constant Scene* scene, Strip strip, Target target)
{
    Queue queue;
    queue.x = strip.left;
    queue.y = strip.bottom;
    queue.waiting = 0;
    Ended ended[2];
    ended[0].size = 0;
    ended[1].size = 0;
    Lanes lanes;
    lanes.taken = 0;
    // Lanes that never receive a ray hold zeros, for which marching() returns false.
    for (int field = 0; field < 9; ++field) lanes.reals[field].all = 0;
    for (int field = 0; field < 3; ++field) lanes.wholes[field].all = 0;
    const uint all = (uint)((1ul << MM_LANES) - 1);
    uint free = all;
    do {
        take(scene, strip, &queue, &lanes, free);
        Ray ray = ray_of(&lanes);
        int fewest = rays_wait(strip, &queue) ? MM_BUSY : 1;
        mask on = marching(*scene, ray);
        uint marches = bits_of(on);
        while ((int)popcount(marches) >= fewest) {
            ray = advance(*scene, ray, on);
            on = marching(*scene, ray);
            marches = bits_of(on);
        }
        keep(&lanes, ray);
        free = all & ~marches;
        leave(&lanes, free & lanes.taken, stopped(*scene, ray), ended);
        lanes.taken &= marches;
        // This is the only call that shades. It serves both lists and, at the end of the strip, their last rays, so
        // that shading is compiled only once.
        int enough = lanes.taken == 0 && !rays_wait(strip, &queue) ? 1 : MM_LANES;
        for (int list = 0; list < 2; ++list) {
            while (ended[list].size >= enough) shade_last(scene, ended + list, target);
        }
    } while (lanes.taken != 0 || rays_wait(strip, &queue));
}
