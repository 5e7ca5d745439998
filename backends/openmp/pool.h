// One pack width: the prelude, the text, and a scheduler around it that keeps lanes busy. Included in a namespace of
// its own; no guard.
//
// A pool of rays, structure of arrays, is marched some steps at a time, and the rays that go on are stored back without
// gaps. Rays that hit wait in a second pool until a whole pack of them can be refined and shaded. When the first pool
// runs low it takes the rays of another tile. No lane waits for a slow neighbour but within one call of the estimator.
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"

// Steps before rays are stored again, at most.
constexpr int steps_at_once = 16;

// Each of these needs the one before.
#include "backends/openmp/rays.h"

#include "backends/openmp/pixels.h"

#include "backends/openmp/cones.h"

// Forgets the first `done` rays of a pool that has less than a pack more.
HWY_INLINE void keep_rest(Pool& pool, int done)
{
    const int rest = pool.size > done ? pool.size - done : 0;
    Traveller a = load(pool, done);
    pool.size = 0;
    append(pool, a, first_lanes(rest));
}

// Shades all rays of the pool but an incomplete last pack; that one too if `all`.
HWY_NOINLINE void shade_pool(const Scene& scene, Pool& ended, const Canvas<MM_REAL>& canvas, Spent& spent, bool all)
{
    int done = 0;
    while (ended.size - done >= pack_lanes || (all && ended.size > done)) {
        Traveller a = load(ended, done);
        const mask on = first_lanes(ended.size - done);
        // Lanes beyond the last ray hit nothing.
        a.ray.last_distance = pick(on, a.ray.last_distance, scene.end);
        store_pixels(shade(scene, a.ray), a.pixel, on, canvas, spent);
        done += pack_lanes;
    }
    if (done == 0) return;
    keep_rest(ended, done);
}

// One step of refinement for every ray of the pool; those that need no more go to `ended`.
HWY_NOINLINE void refine_pool(const Scene& scene, Pool& pool, Pool& ended, const Canvas<MM_REAL>& canvas, Spent& spent)
{
    const int size = pool.size;
    pool.size = 0;
    for (int from = 0; from < size; from += pack_lanes) {
        Traveller a = load(pool, from);
        const mask on = first_lanes(size - from);
        a.ray = refine_step(scene, a.ray, on);
        const mask go = on && refining(scene, a.ray);
        append(pool, a, go);
        const mask stays = on && !go;
        if (!any(stays)) continue;
        append(ended, a, stays);
        if (ended.size > pool_rays - pack_lanes) shade_pool(scene, ended, canvas, spent, false);
    }
}

// A pack covers a rectangle of pixels, as square as its lanes allow, so that its rays stay close to each other.
constexpr int rectangle_width()
{
    int width = 1;
    while (width * width < pack_lanes) width *= 2;
    return width;
}
constexpr int log2_of(int n) { return n == 1 ? 0 : 1 + log2_of(n / 2); }
constexpr int pack_width = rectangle_width();
constexpr int pack_height = pack_lanes / pack_width;
static_assert(pack_width <= tile_side && pack_height <= tile_side);

// Begins the rays of tile number `tile` of the group, where its cones of 2 x 2 pixels came to, if there are any.
HWY_NOINLINE void begin_tile(const Scene& scene, const Group& group, int tile, const Canvas<MM_REAL>& canvas,
                             const Cones<2>* cones, Pool& pool, Spent& spent)
{
    const int left = group.left[tile];
    const int bottom = group.bottom[tile];
    const whole lane = lane_numbers();
    whole across;
    whole up;
    Int places[pack_lanes];
    for (int n = 0; n < pack_lanes; ++n) places[n] = static_cast<Int>(n / pack_width) * scene.width + n % pack_width;
    EACH_REGISTER(across.of[u] = hn::And(lane.of[u], hn::Set(Wholes(), pack_width - 1));
                  up.of[u] = hn::ShiftRight<log2_of(pack_width)>(lane.of[u]);)
    for (int y0 = bottom; y0 < bottom + tile_side && y0 < canvas.end_row; y0 += pack_height) {
        for (int x0 = left; x0 < left + tile_side && x0 < scene.width; x0 += pack_width) {
            const whole x = across + whole(static_cast<Int>(x0));
            const whole y = up + whole(static_cast<Int>(y0));
            const real i = real_of(x);
            const real j = real_of(y);
            Traveller a;
            a.pixel = load_lanes(places) + whole(static_cast<Int>(y0 - canvas.first_row) * scene.width + x0);
            const mask on = i < scene.width && j < canvas.end_row;
            a.ray = begin(scene, i, j);
            if (cones != nullptr) {
                Lanes lanes;
                for (int n = 0; n < pack_lanes; ++n) {
                    const int dx = x0 - left + n % pack_width;
                    const int dy = y0 - bottom + n / pack_width;
                    const int block = tile * blocks_of_tile(2) + dy / 2 * blocks_across(2) + dx / 2;
                    const bool first = dx % 2 == 0 && dy % 2 == 0;
                    lanes.start[n] = cones->start[block];
                    lanes.estimates[n] = first ? cones->estimates[block] : Int(0);
                    lanes.iterations[n] = first ? cones->iterations[block] : Int(0);
                }
                a.ray.t = larger(a.ray.t, load_lanes(lanes.start));
                a.ray.estimates = load_lanes(lanes.estimates);
                a.ray.iterations = load_lanes(lanes.iterations);
            }
            const mask go = marching(scene, a.ray);
            append(pool, a, on && go);
            if (any(on && !go)) store_pixels(missed(scene, a.ray), a.pixel, on && !go, canvas, spent);
        }
    }
}

// Begins a group's tiles, with cones of 8 and of 2 pixels before the rays.
HWY_NOINLINE void begin_group(const Scene& scene, const Group& group, const Canvas<MM_REAL>& canvas, Pool& pool,
                              Pool& cones, Spent& spent)
{
    Cones<8> coarse;
    Cones<2> fine;
    const bool with_cones = canvas.pitch > 0;
    if (with_cones) {
        march_cones<8, tile_side>(scene, group, canvas.pitch, nullptr, cones, coarse);
        march_cones<2, 8>(scene, group, canvas.pitch, &coarse, cones, fine);
    }
    for (int tile = 0; tile < group.count; ++tile) {
        begin_tile(scene, group, tile, canvas, with_cones ? &fine : nullptr, pool, spent);
    }
}

// One step of marching for every ray of the pool; hits go on to be refined, or to be shaded where none is.
HWY_NOINLINE void march_pool(const Scene& scene, Pool& pool, Pool& hits, Pool& ended, const Canvas<MM_REAL>& canvas,
                             Spent& spent)
{
    const int size = pool.size;
    pool.size = 0;
    for (int from = 0; from < size; from += pack_lanes) {
        Traveller a = load(pool, from);
        const mask on = first_lanes(size - from);
        // Some steps before the rays are stored again, while few lanes have ended.
        const int enough = lanes_on(on) * 3 / 4;
        mask go = on;
        int step = 0;
        do {
            a.ray = advance(scene, a.ray, go);
            go = go && marching(scene, a.ray);
        } while (++step < steps_at_once && lanes_on(go) > enough);
        append(pool, a, go);
        const mask stays = on && !go;
        if (!any(stays)) continue;
        const mask hit = stays && has_hit(scene, a.ray);
        const mask gone = stays && !hit;
        if (any(gone)) store_pixels(missed(scene, a.ray), a.pixel, gone, canvas, spent);
        if (scene.canonical != 0) {
            a.ray = refine_begin(scene, a.ray);
            const mask coarse = hit && refining(scene, a.ray);
            append(hits, a, coarse);
            append(ended, a, hit && !coarse);
            while (hits.size > pool_rays - pack_lanes) refine_pool(scene, hits, ended, canvas, spent);
        } else {
            append(ended, a, hit);
        }
        if (ended.size > pool_rays - pack_lanes) shade_pool(scene, ended, canvas, spent, false);
    }
}

// Begins tiles while the pool has room for a group; false when there are no more.
HWY_NOINLINE bool begin_tiles(const Scene& scene, const Tiles& tiles, const Canvas<MM_REAL>& canvas, Pool& pool,
                              Pool& cones, Spent& spent)
{
    bool more = true;
    while (more && pool.size <= pool_rays - group_tiles * tile_pixels) {
        Group group;
        group.count = 0;
        while (group.count < group_tiles && more) {
            more = tiles.next(tiles.source, group.left[group.count], group.bottom[group.count]);
            group.count += more ? 1 : 0;
        }
        if (group.count > 0) begin_group(scene, group, canvas, pool, cones, spent);
    }
    return more;
}

// A thread's memory.
struct Pools {
    Pool marching;
    Pool cones;
    Pool hits;   // to be refined
    Pool ended;  // to be shaded
};

// Draws tiles until there are no more.
Spent draw_tiles(const void* data, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* memory)
{
    Spent spent{0, 0, 0};
    const Scene& scene = *static_cast<const Scene*>(data);
    auto& [pool, cones, hits, ended] = *static_cast<Pools*>(memory);
    pool.size = hits.size = ended.size = 0;
    bool more = true;
    while (more || pool.size > 0) {
        more = more && begin_tiles(scene, tiles, canvas, pool, cones, spent);
        march_pool(scene, pool, hits, ended, canvas, spent);
        while (hits.size > pool_rays / 2) refine_pool(scene, hits, ended, canvas, spent);
    }
    while (hits.size > 0) refine_pool(scene, hits, ended, canvas, spent);
    shade_pool(scene, ended, canvas, spent, true);
    return spent;
}
#include "core/kernel/prelude/undefine.h"
#undef EACH_REGISTER
