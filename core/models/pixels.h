// SPDX-License-Identifier: Apache-2.0
// The kernel source, and the functions that cells.h, for CPUs, and threads.h, for GPUs, have in common. Has no include
// guard: the source file of each compiled kernel includes cells.h or threads.h once, in its own namespace and after
// core/models/job.h. The including file defines MM_REAL, MM_REAL_IS_FLOAT, MM_FRACTAL_FILE, and MM_MODE_exact or
// MM_MODE_fast; it may define MM_NORMALS_OF_SCENE, see fixed_scene().
#ifndef MM_PRELUDE
#define MM_PRELUDE "core/kernel/prelude/scalar.h"
#endif
#include MM_PRELUDE
#include "core/kernel/text.h"
#define MM_TRUNCATED(x) static_cast<int>(x)
#include "core/kernel/bytes.h"
#undef MM_TRUNCATED

// Scene::canonical and Scene::differences are constants here, fixed by precision and mode. core/models/executor.h
// rejects scenes with other values. With MM_NORMALS_OF_SCENE, Scene::differences may have any value.
#ifdef MM_MODE_fast
constexpr int canonical = 1;
#else
constexpr int canonical = 0;
#endif
// Value of Scene::differences, unless the scene has tetrahedron normals (2).
constexpr int differences = !MM_REAL_IS_FLOAT && canonical == 0;

using KernelArguments = mandelmarch::job::KernelArguments<Scene, MM_REAL>;

// MM_ANEW(value) makes the compiler assume that the value has changed, so that it recomputes expressions of the value
// instead of keeping them in registers. The fewer registers a kernel needs, the more of its threads are resident on a
// GPU; therefore even short-lived values are loaded from the job again each time.
#ifndef MM_ANEW
#define MM_ANEW(value) asm volatile("" : "+r"(value))
#endif

FN Scene fixed_scene(const KernelArguments* job)
{
    Scene scene = job->scene;
    scene.canonical = canonical;
#ifndef MM_NORMALS_OF_SCENE
    scene.differences = scene.differences == 2 ? 2 : differences;
#endif
    return scene;
}

// Stores a pixel in the planes: only its colour if the job needs bytes.
FN void put_pixel(const KernelArguments* job, int at, int pixels, Pixel pixel)
{
    job->reals[at] = pixel.colour.x;
    job->reals[at + pixels] = pixel.colour.y;
    job->reals[at + 2 * pixels] = pixel.colour.z;
    if (job->bytes != nullptr) return;
    job->reals[at + 3 * pixels] = pixel.depth;
    job->wholes[at] = pixel.steps;
    job->wholes[at + pixels] = pixel.de_calls;
    job->wholes[at + 2 * pixels] = pixel.iterations;
}

FN void put_bytes(const KernelArguments* job, int at, real red, real green, real blue)
{
    unsigned char* bytes = job->bytes + 3 * static_cast<long>(at);
    bytes[0] = static_cast<unsigned char>(byte_of(red));
    bytes[1] = static_cast<unsigned char>(byte_of(green));
    bytes[2] = static_cast<unsigned char>(byte_of(blue));
}

// Stores a pixel in the job's bytes, or in its planes.
FN void put(const KernelArguments* job, int at, Pixel pixel)
{
    if (job->bytes != nullptr) {
        put_bytes(job, at, pixel.colour.x, pixel.colour.y, pixel.colour.z);
    } else {
        put_pixel(job, at, job->scene.width * job->rows, pixel);
    }
}

// Returns the number of tiles with cones in a row or column of `pixels` pixels. tiles_along() cannot be called on a
// GPU.
FN int tiles_in(const KernelArguments* job, int pixels) { return (pixels + job->cone_side - 1) / job->cone_side; }

FN int tile_columns(const KernelArguments* job) { return tiles_in(job, job->scene.width); }

// Begins the cone of the tile with index `at`, counted row by row.
FN Ray begun_cone(const KernelArguments* job, Scene scene, int at)
{
    const int side = job->cone_side;
    const int y = at / tile_columns(job);
    const int x = at - y * tile_columns(job);
    return begin_cone(scene, real(x * side), real(job->first_row + y * side), real(side));
}

// Stores the work of a tile's cone, and where its rays begin.
FN void put_cone(const KernelArguments* job, Scene scene, int at, Ray cone)
{
    job->starts[at] = cone_end(scene, cone);
    job->cone_work[2 * at] = cone.de_calls;
    job->cone_work[2 * at + 1] = cone.iterations;
}

// Returns the t at which the cone of a pixel's tile has ended; 0: there are no cones. y: the row in the job.
FN real tile_start(const KernelArguments* job, int x, int y)
{
    const int side = job->cone_side;
    if (canonical == 0 || side == 0) return 0;
    return job->starts[y / side * tile_columns(job) + x / side];
}
