// SPDX-License-Identifier: Apache-2.0
// The steps of a lane of a GPU's warp: it takes a pixel from a job's queue, begins the pixel's ray, and shades the
// ray's hit. See core/models/pixels.h; threads.h and warps.h use it.
#include "core/models/pixels.h"

// Returns the scene, loaded from memory again.
FN Scene scene_of(const KernelArguments* job)
{
    MM_ANEW(job);
    return fixed_scene(job);
}

// Returns the scene for marching. In exact mode, marching does not depend on `differences`, so `differences` is made a
// constant.
FN Scene march_scene_of(const KernelArguments* job)
{
    Scene scene = scene_of(job);
    if (canonical == 0) scene.differences = differences;
    return scene;
}

// Marches the cone of the tile with the thread's index, if there is one.
FN void march_tile(const KernelArguments* job, int thread)
{
    if (thread >= tile_columns(job) * tiles_in(job, job->rows)) return;
    Ray cone = begun_cone(job, scene_of(job), thread);
    while (cone_goes(cone)) {
        const scalar width = cone_width(march_scene_of(job), real(job->cone_side));
        cone = advanced_cone(march_scene_of(job), cone, width, probe(march_scene_of(job), cone, true), true);
    }
    put_cone(job, scene_of(job), thread, cone);
}

// The pixel of a GPU thread.
struct Place {
    bool inside;  // the pixel is in the job
    int x;
    int y;       // row, counted from the job's first row
    int at;      // index in a plane
    int pixels;  // number of pixels of a plane
};

FN Place place_of(const KernelArguments* job, int thread)
{
    constexpr int warp_width = mandelmarch::job::warp_width;
    constexpr int warp_height = mandelmarch::job::warp_height;
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

// Begins the ray of a place, without the start of its tile.
FN Ray begun(const KernelArguments* job, Place place)
{
    const real* column = job->camera + place.x;
    const real* row = job->camera + (2 * job->scene.width + job->first_row + place.y);
    const Complex a = complex_number(column[0], column[job->scene.width]);
    const Complex b = complex_number(row[0], row[job->scene.height]);
    const vec3 direction = along_axes(scene_of(job), a, b);
    return begin_along(scene_of(job), direction);
}

// Begins the ray of a place at the end of its tile's cone.
FN Ray begun_by_cone(const KernelArguments* job, Place place)
{
    Ray ray = begun(job, place);
    ray.t = larger(tile_start(job, place.x, place.y), ray.t);
    return ray;
}

// Increments a number in memory as an atomic operation, and returns the number before.
#ifndef MM_TAKE
#define MM_TAKE(number) __atomic_fetch_add(&(number), 1, __ATOMIC_RELAXED)
#endif

// Number of steps between two refills. All lanes of a warp wait while some of them are refilled.
constexpr int steps_of_round = 4;

// Returns the number of thread indices that cover the job, in rectangles of one warp as in blocks_of() in
// core/models/job.h.
FN int places_of(const KernelArguments* job)
{
    constexpr int warp_width = mandelmarch::job::warp_width;
    constexpr int warp_height = mandelmarch::job::warp_height;
    MM_ANEW(job);
    const int columns = (job->scene.width + warp_width - 1) / warp_width;
    const int lines = (job->rows + warp_height - 1) / warp_height;
    return columns * lines * (warp_width * warp_height);
}

// Takes the next index of the job's queue whose pixel is in the job. Returns places_of() or more if there is none.
FN int taken_place(const KernelArguments* job)
{
    int at = 0;
    do at = MM_TAKE(*job->taken);
    while (at < places_of(job) && !place_of(job, at).inside);
    return at;
}

// Returns the pixel of a hit. The stages are those of shade() in core/kernel/shade.h, but each loads the scene again,
// so that a number of the look is in a register only where it is used. The structs are not const: g++ 12 would keep
// const ones in the GPU's memory.
FN Pixel shaded(const KernelArguments* job, Hit hit)
{
    ShadingPoint at = shading_point(scene_of(job), hit);
    Normal normal = normal_at(scene_of(job), at.p, at.t, true);
    vec3 n = facing(scene_of(job), hit.direction, normal.direction, at.t);
    Pixel pixel;
    pixel.depth = at.t;
    pixel.steps = hit.steps;
    pixel.de_calls = hit.de_calls + normal.de_calls;
    pixel.iterations = hit.iterations + normal.iterations;
    if (has_look(scene_of(job)) != 0) {
        Occlusion found = occlusion(scene_of(job), at.p, n, at.t, true);
        Lighting there = lighting(scene_of(job), hit.direction, n, at.t, found);
        pixel.colour = look_shown(scene_of(job), there, orbit_trap(scene_of(job), at.p, true));
        pixel.de_calls = pixel.de_calls + found.de_calls + 1;  // the orbit trap counts as one more evaluation
        pixel.iterations = pixel.iterations + found.iterations;
    } else {
        pixel.colour = lit(scene_of(job), hit.direction, n);
    }
    return pixel;
}
