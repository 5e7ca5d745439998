// SPDX-License-Identifier: Apache-2.0
// The functions that a loop on a CPU calls for a job: march_tile() for each tile, if rays begin at the ends of cones;
// then draw_cell() for each cell of a lattice. See core/models/pixels.h.
#include "core/models/pixels.h"

// Returns the cone of a tile after its end.
FN Ray ended_cone(const KernelArguments* job, int at)
{
    const Scene scene = fixed_scene(job);
    return march_cone(scene, begun_cone(job, scene, at), cone_width(scene, real(job->cone_side)));
}

FN void march_tile(const KernelArguments* job, int at) { put_cone(job, fixed_scene(job), at, ended_cone(job, at)); }

// Returns the t at which the rays of the cell at (x, y) begin, from the depths of the pixels at its corners. Corners
// outside the job have the depth unclear_miss(). 0: the lattice is the first one.
FN real cell_start(const KernelArguments* job, int x, int y)
{
    const int side = job->lattice.before;
    if (canonical == 0 || side == 0) return 0;
    real least = beyond_scene(job->scene);
    real greatest = clear_miss();
    for (int corner = 0; corner < 4; ++corner) {
        const int column = x + corner % 2 * side;
        const int row = y + corner / 2 * side;
        const bool inside = column < job->scene.width && row < job->rows;
        const real depth = inside ? job->depths[(row * job->scene.width + column) / 2] : unclear_miss();
        least = smaller(depth, least);
        greatest = larger(depth, greatest);
    }
    return neighbour_start(job->scene, least, greatest);
}

// Marches the ray of pixel (x, y) until it stops. In fast mode it begins at the end of its tile's cone, or at
// `from_neighbours`.
FN Ray marched(const KernelArguments* job, const Scene& scene, int x, int y, real from_neighbours)
{
    const Ray ray = begin(scene, real(x), real(job->first_row + y));
    if (canonical == 0) return march(scene, ray, scene.max_steps);
    const mandelmarch::Lattice lattice = job->lattice;
    LatticeRay a = begin_lattice(scene, ray, tile_start(job, x, y), from_neighbours);
    while (marching(scene, a.ray)) a = advance_lattice(scene, a, lattice.before, lattice.apart, true);
    if (lattice.apart > 1) job->depths[(y * scene.width + x) / 2] = depth_passed_on(scene, a);
    return a.ray;
}

// Renders the pixels of the lattice in the cell whose lower left pixel is (x, y). Calls put(index in a plane, pixel).
template <class Put>
FN void draw_cell_at(const KernelArguments* job, int x, int y, const Put& put)
{
    const Scene scene = fixed_scene(job);
    const mandelmarch::Lattice lattice = job->lattice;
    const real from_neighbours = cell_start(job, x, y);
    const int first = lattice.before > 0 ? 1 : 0;
    for (int place = first; place < first + places_of_cell(lattice); ++place) {
        const int column = x + place % 2 * lattice.apart;
        const int row = y + place / 2 * lattice.apart;
        if (column >= scene.width || row >= job->rows) continue;
        put(row * scene.width + column, drawn(scene, marched(job, scene, column, row, from_neighbours)));
    }
}

// Renders the cell with index `at`, counted row by row, into the job's bytes or planes.
FN void draw_cell(const KernelArguments* job, int at)
{
    const int side = cell_side(job->lattice);
    const int columns = mandelmarch::tiles_along(job->scene.width, side);
    const int y = at / columns;
    const int x = at - y * columns;
    draw_cell_at(job, x * side, y * side, [job](int pixel, const Pixel& done) { put(job, pixel, done); });
}

#include "core/kernel/prelude/undefine.h"
