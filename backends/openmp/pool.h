// SPDX-License-Identifier: Apache-2.0
// The scheduler around the text that keeps lanes busy. Included in a namespace of its own, with MM_REGISTERS 1; no
// guard.
//
// A pool of rays, structure of arrays, is marched some steps at a time, and the rays that go on are stored without
// gaps. Rays that hit wait in a second pool until whole packs of them can be refined and shaded. When the first pool
// runs low it takes the rays of another tile. No lane waits for a slow neighbour but within one call of the estimator.
//
// All of it handles one register at a time, which leaves values in registers, but for samples: there the registers of a
// wide pack hide each other's latency.
#include "backends/openmp/samples.h"
static_assert(MM_REGISTERS == 1);

// Steps before rays are stored without gaps again, at most.
constexpr int steps_at_once = 16;

// A thread's memory.
struct Pools {
    Pool marching;
    Pool cones;
    Pool hits;     // to be refined
    Pool ended;    // to be shaded
    int refining;  // the first hits that are being refined; the others have not begun
};

// What a thread draws, and with what.
struct Drawing {
    const Scene& scene;
    Scene around_blocks;  // the same with the canvas's block_hull
    const Canvas<MM_REAL>& canvas;
    const Tiles& tiles;
    Pools& pools;
    Width wide;     // for samples
    Width shading;  // for finished rays
    Spent spent;

    int lanes() const { return wide.registers * register_lanes; }  // of a pack of samples
};

// Each of these needs the one before.
#include "backends/openmp/passes.h"

#include "backends/openmp/blocks.h"

#include "backends/openmp/cones.h"

#include "backends/openmp/sites.h"

#include "backends/openmp/begin.h"

// Draws tiles until there are no more.
Spent draw_tiles(const void* data, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* memory, const Width& wide)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    Drawing d = drawing(scene, canvas, tiles, *static_cast<Pools*>(memory), wide);
    bool more = true;
    while (more || d.pools.marching.size > 0) {
        more = more && begin_tiles(d);
        march_pool(d);
        while (d.pools.hits.size > pool_rays / 2) refine_pool(d);
    }
    while (d.pools.hits.size > 0) refine_pool(d);
    shade_pool(d, true);
    return d.spent;
}
