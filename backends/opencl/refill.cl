// SPDX-License-Identifier: Apache-2.0
// Renders a strip of pixels with refill: a lane whose ray has ended takes the strip's next ray (persistent threads:
// Aila and Laine, "Understanding the efficiency of ray traversal on GPUs", HPG 2009). Hits are collected until they
// fill a vector, which is then shaded. A pixel's result does not depend on the lane that computes it. Loops over the
// fields of a lane are unrolled, as clang would otherwise gather and scatter the fields as vectors, which is slower.

// While the strip has rays left, idle lanes are refilled as soon as fewer than MM_BUSY lanes are marching.
#define MM_BUSY (MM_LANES - MM_LANES / 8)

FN int lowest_of(uint bits) { return (int)popcount((bits & -bits) - 1); }

// The rays of the strip's current block, and the position of the next block.
struct Queue {
    int x;
    int y;
    int place;
    uint waiting;  // bit n: no lane has taken the block's ray n yet
    int at[MM_LANES];
    union Reals reals[6];    // direction, end, t, last_t
    union Reals from_cones;  // the t at which the cones of the cells' tiles have ended
    union Reals least;       // min of the depths of the cells' neighbours, for neighbour_start()
    union Reals greatest;    // max of these depths
};

// The rays in the lanes: one vector for each field of a Ray, and the room of a LatticeRay.
struct Lanes {
    union Reals reals[10];
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

// Finds where the rays of a block of cells can begin. All pixels of a cell have the same tile and the same neighbours:
// the lower left pixels of the cell and of the cells to the right, above, and above and to the right.
FN void find_starts(Starts starts, int width, int rows, Queue* queue)
{
    int side = cell_side(starts);
    scalar depths[MM_HEIGHT + 1][MM_WIDTH + 1];
    for (int row = 0; row <= MM_HEIGHT; ++row) {
        for (int column = 0; column <= MM_WIDTH; ++column) {
            int x = (queue->x + column) * side;
            int y = (queue->y + row) * side;
            bool inside = x < width && y < rows;
            // Outside the band there is unclear_miss().
            depths[row][column] = inside && starts.before > 0 ? starts.depths[(y * width + x) / 2] : 0;
            if (row == MM_HEIGHT || column == MM_WIDTH) continue;
            queue->from_cones.of[row * MM_WIDTH + column] = inside ? tile_start(starts, x, y) : 0;
        }
    }
#pragma unroll
    for (int lane = 0; lane < MM_LANES; ++lane) {
        const scalar* low = &depths[lane / MM_WIDTH][lane % MM_WIDTH];
        const scalar* high = low + MM_WIDTH + 1;
        queue->least.of[lane] = fmin(fmin(low[0], low[1]), fmin(high[0], high[1]));
        queue->greatest.of[lane] = fmax(fmax(low[0], low[1]), fmax(high[0], high[1]));
    }
}

// Stores the depths that the rays in the lanes `some` pass on, if the lattice has later ones.
FN void pass_on(Starts starts, const int* at, uint some, real passed)
{
    union Reals depths = {passed};
    if (starts.apart == 1) return;
    for (; some != 0; some &= some - 1) {
        int lane = lowest_of(some);
        starts.depths[at[lane] / 2] = depths.of[lane];
    }
}

// Begins the rays of the queue's next block. Rays that miss the hull, or that cannot hit by their starts, are finished
// at once.
FN void begin_block(__constant Scene* scene, Strip strip, Starts starts, Target target, Queue* queue)
{
    Block block = block_at(strip, starts, queue->x, queue->y, queue->place, scene->width);
    if (queue->place < 2) find_starts(starts, scene->width, strip.rows, queue);
    union Reals i;
    union Reals j;
    uint inside = 0;
    for (int lane = 0; lane < MM_LANES; ++lane) {
        i.of[lane] = (scalar)block.x[lane];
        j.of[lane] = (scalar)(strip.first_row + block.y[lane]);
        if (block.at[lane] >= 0) inside |= 1u << lane;
    }
    LatticeRay begun = begin_lattice(*scene, begin(*scene, i.all, j.all), queue->from_cones.all,
                                     neighbour_start(*scene, queue->least.all, queue->greatest.all));
    uint marches = inside & bits_of(marching(*scene, begun.ray));
    queue->waiting = marches;
    for (int lane = 0; lane < MM_LANES; ++lane) {
        queue->at[lane] = block.at[lane];
        if ((marches >> lane & 1) != 0) block.at[lane] = -1;
    }
    if (marches != inside) {
        put_lanes(target, block.at, MM_LANES, missed(*scene, stopped(*scene, begun.ray)));
        pass_on(starts, block.at, inside & ~marches, depth_passed_on(*scene, begun));
    }
    queue->reals[0].all = begun.ray.direction.x;
    queue->reals[1].all = begun.ray.direction.y;
    queue->reals[2].all = begun.ray.direction.z;
    queue->reals[3].all = begun.ray.end;
    queue->reals[4].all = begun.ray.t;
    queue->reals[5].all = begun.ray.last_t;
    if (starts.before > 0 && queue->place < 3) {
        queue->place += 1;
        return;
    }
    queue->place = starts.before > 0 ? 1 : 0;
    queue->y += MM_HEIGHT;
    if (queue->y >= strip.top) {
        queue->y = strip.bottom;
        queue->x += MM_WIDTH;
    }
}

FN bool rays_wait(Strip strip, const Queue* queue) { return queue->waiting != 0 || queue->x < strip.right; }

// Starts a ray of the strip in each free lane, while the strip has rays left. Sets the same values as begin_along().
FN void take(__constant Scene* scene, Strip strip, Starts starts, Target target, Queue* queue, Lanes* lanes,
             uint free)
{
    union Wholes begun = {0};
    for (; free != 0 && rays_wait(strip, queue); free &= free - 1) {
        int lane = lowest_of(free);
        while (queue->waiting == 0 && rays_wait(strip, queue)) begin_block(scene, strip, starts, target, queue);
        if (queue->waiting == 0) break;
        int from = lowest_of(queue->waiting);
        queue->waiting &= queue->waiting - 1;
#pragma unroll
        for (int field = 0; field < 6; ++field) lanes->reals[field].of[lane] = queue->reals[field].of[from];
        lanes->at[lane] = queue->at[from];
        lanes->taken |= 1u << lane;
        begun.of[lane] = -1;
    }
    real end = scene->end;
    lanes->reals[6].all = pick(begun.all, end, lanes->reals[6].all);
    lanes->reals[7].all = pick(begun.all, 0, lanes->reals[7].all);
    lanes->reals[8].all = pick(begun.all, end, lanes->reals[8].all);
    lanes->reals[9].all = pick(begun.all, end, lanes->reals[9].all);
    for (int field = 0; field < 3; ++field) lanes->wholes[field].all &= ~begun.all;
}

FN LatticeRay ray_of(const Lanes* lanes)
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
    LatticeRay a;
    a.ray = ray;
    a.start = 0;
    a.room = lanes->reals[9].all;
    return a;
}

FN void keep(Lanes* lanes, LatticeRay a)
{
    Ray ray = a.ray;
    lanes->reals[4].all = ray.t;
    lanes->reals[5].all = ray.last_t;
    lanes->reals[6].all = ray.last_distance;
    lanes->reals[7].all = ray.before_t;
    lanes->reals[8].all = ray.before_distance;
    lanes->wholes[0].all = ray.steps;
    lanes->wholes[1].all = ray.de_calls;
    lanes->wholes[2].all = ray.iterations;
    lanes->reals[9].all = a.room;
}

// Finishes the pixels of the lanes `done` whose rays have missed. Appends the hits of the others to the list.
FN void leave(__constant Scene* scene, const Lanes* lanes, uint done, Hit hit, Target target, Ended* ended)
{
    uint hits = done & bits_of(is_hit(hit));
    if (hits != done) {
        int at[MM_LANES];
        for (int lane = 0; lane < MM_LANES; ++lane) at[lane] = ((done & ~hits) >> lane & 1) != 0 ? lanes->at[lane] : -1;
        put_lanes(target, at, MM_LANES, missed(*scene, hit));
    }
    union Reals reals[9] = {{hit.direction.x}, {hit.direction.y}, {hit.direction.z}, {hit.state},  {hit.t},
                            {hit.below_t},     {hit.below_f},     {hit.above_t},     {hit.above_f}};
    for (; hits != 0; hits &= hits - 1) {
        int lane = lowest_of(hits);
        int place = ended->size++;
#pragma unroll
        for (int field = 0; field < 9; ++field) ended->reals[field][place] = reals[field].of[lane];
#pragma unroll
        for (int field = 0; field < 3; ++field) ended->wholes[field][place] = lanes->wholes[field].of[lane];
        ended->at[place] = lanes->at[lane];
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

// Takes steps with the rays in the lanes while at least `fewest` of them march. Returns the bits of those that still
// do.
FN uint march_lanes(__constant Scene* scene, Starts starts, int fewest, LatticeRay* a)
{
    mask on = marching(*scene, a->ray);
    uint marches = bits_of(on);
    while ((int)popcount(marches) >= fewest) {
#if MM_EXACT
        a->ray = advance(*scene, a->ray, on);
#else
        *a = advance_lattice(*scene, *a, starts.before, starts.apart, on);
#endif
        on = marching(*scene, a->ray);
        marches = bits_of(on);
    }
    return marches;
}

FN void draw_refilling(__constant Scene* scene, Strip strip, Starts starts, Target target)
{
    Queue queue;
    queue.x = strip.left;
    queue.y = strip.bottom;
    queue.place = starts.before > 0 ? 1 : 0;
    queue.waiting = 0;
    Ended ended;
    ended.size = 0;
    Lanes lanes;
    lanes.taken = 0;
    // Lanes that never receive a ray hold zeros, for which marching() returns false.
    for (int field = 0; field < 10; ++field) lanes.reals[field].all = 0;
    for (int field = 0; field < 3; ++field) lanes.wholes[field].all = 0;
    const uint all = (uint)((1ul << MM_LANES) - 1);
    uint free = all;
    do {
        take(scene, strip, starts, target, &queue, &lanes, free);
        LatticeRay a = ray_of(&lanes);
        uint marches = march_lanes(scene, starts, rays_wait(strip, &queue) ? MM_BUSY : 1, &a);
        keep(&lanes, a);
        free = all & ~marches;
        uint done = free & lanes.taken;
        leave(scene, &lanes, done, stopped(*scene, a.ray), target, &ended);
        pass_on(starts, lanes.at, done, depth_passed_on(*scene, a));
        lanes.taken &= marches;
        // This is the only call that shades. It also serves the last rays of the strip, so that shading is compiled
        // only once.
        int enough = lanes.taken == 0 && !rays_wait(strip, &queue) ? 1 : MM_LANES;
        while (ended.size >= enough) shade_last(scene, &ended, target);
    } while (lanes.taken != 0 || rays_wait(strip, &queue));
}
