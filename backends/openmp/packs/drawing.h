// SPDX-License-Identifier: Apache-2.0
// State of a thread's rendering, and the pools of its rays.

static_assert(MM_REGISTERS == 1);

// The ray pools of a thread.
struct Pools {
    Pool marching;
    Pool cones;
    Pool hits;     // rays to refine
    Pool ended;    // rays to shade
    Pool sharing;  // rays to shade with the occlusion of neighbouring pixels
    int refining;  // the first `refining` rays of `hits` have begun their refinement
    int alone;     // the first `alone` rays of `ended` are known not to share occlusion
};

// Scene, canvas, pools and functions of a thread's rendering.
struct Drawing {
    const Scene& scene;
    const Canvas<MM_REAL>& canvas;
    const Tiles& tiles;
    Pools& pools;
    Sampling sampling;
    Shading shading;
    WorkCounts spent;
};

// Makes a Drawing with empty pools.
HWY_INLINE Drawing drawing(const Scene& scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, Pools& pools,
                           const Sampling& sampling, const Shading& shading)
{
    pools.refining = pools.marching.size = pools.cones.size = pools.hits.size = pools.ended.size = 0;
    pools.alone = pools.sharing.size = 0;
    return {scene, canvas, tiles, pools, sampling, shading, {0, 0, 0}};
}
