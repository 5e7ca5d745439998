// One pack width: the prelude, the text, and a scheduler around it that keeps lanes busy. Included in a namespace of
// its own; no guard.
//
// A pool of rays, structure of arrays, is marched one step at a time, and the rays that go on are stored back without
// gaps. Rays that hit wait in a second pool until a whole pack of them can be refined and shaded. When the first pool
// runs low it takes the rays of another tile. No lane waits for a slow neighbour but within one call of the estimator.
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"

// Rays in a pool: enough that few packs have gaps, few enough to stay in a core's cache.
constexpr int pool_rays = 4096;

struct Pool {
    static constexpr int reals = 9;
    static constexpr int wholes = 4;
    MM_REAL real_fields[reals][pool_rays + 2 * pack_lanes];
    Int whole_fields[wholes][pool_rays + 2 * pack_lanes];
    int size;
};

// A ray with the place of its pixel in the canvas.
struct Traveller {
    Ray ray;
    whole pixel;
};

// Calls f(field, register's values) for each field of register u.
template <class OnReal, class OnWhole>
HWY_INLINE void each_field(Traveller& a, int u, OnReal on_real, OnWhole on_whole)
{
    on_real(0, a.ray.direction.x.of[u]);
    on_real(1, a.ray.direction.y.of[u]);
    on_real(2, a.ray.direction.z.of[u]);
    on_real(3, a.ray.end.of[u]);
    on_real(4, a.ray.t.of[u]);
    on_real(5, a.ray.last_t.of[u]);
    on_real(6, a.ray.last_distance.of[u]);
    on_real(7, a.ray.before_t.of[u]);
    on_real(8, a.ray.before_distance.of[u]);
    on_whole(0, a.ray.steps.of[u]);
    on_whole(1, a.ray.estimates.of[u]);
    on_whole(2, a.ray.iterations.of[u]);
    on_whole(3, a.pixel.of[u]);
}

HWY_NOINLINE Traveller load(const Pool& pool, int from)
{
    Traveller a;
    for (int u = 0; u < MM_REGISTERS; ++u) {
        const int at = from + u * register_lanes;
        each_field(
            a, u, [&](int f, auto& v) HWY_ATTR { v = hn::LoadU(Reals(), pool.real_fields[f] + at); },
            [&](int f, auto& v) HWY_ATTR { v = hn::LoadU(Wholes(), pool.whole_fields[f] + at); });
    }
    return a;
}

// Appends the lanes that are on. The pool has room for a pack more than it holds.
HWY_NOINLINE void append(Pool& pool, Traveller& a, const mask& on)
{
    for (int u = 0; u < MM_REGISTERS; ++u) {
        const auto lanes = on.of[u];
        const auto whole_lanes = hn::RebindMask(Wholes(), lanes);
        const int count_on = static_cast<int>(hn::CountTrue(Reals(), lanes));
        if (count_on == 0) continue;
        const int at = pool.size;
        if (count_on == register_lanes) {
            each_field(
                a, u, [&](int f, auto& v) HWY_ATTR { hn::StoreU(v, Reals(), pool.real_fields[f] + at); },
                [&](int f, auto& v) HWY_ATTR { hn::StoreU(v, Wholes(), pool.whole_fields[f] + at); });
        } else {
            each_field(
                a, u,
                [&](int f, auto& v) HWY_ATTR { hn::StoreU(hn::Compress(v, lanes), Reals(), pool.real_fields[f] + at); },
                [&](int f, auto& v)
                    HWY_ATTR { hn::StoreU(hn::Compress(v, whole_lanes), Wholes(), pool.whole_fields[f] + at); });
        }
        pool.size += count_on;
    }
}

// The first `lanes` lanes.
HWY_INLINE mask first_lanes(int lanes)
{
    mask on;
    for (int u = 0; u < MM_REGISTERS; ++u) {
        const int rest = lanes - u * register_lanes;
        on.of[u] = hn::FirstN(Reals(), static_cast<std::size_t>(rest < 0 ? 0 : rest));
    }
    return on;
}

HWY_INLINE void store_lanes(const real& from, MM_REAL* to)
{
    for (int u = 0; u < MM_REGISTERS; ++u) hn::StoreU(from.of[u], Reals(), to + u * register_lanes);
}

HWY_INLINE void store_lanes(const whole& from, Int* to)
{
    for (int u = 0; u < MM_REGISTERS; ++u) hn::StoreU(from.of[u], Wholes(), to + u * register_lanes);
}

// Finished pixels to their places on the canvas.
HWY_NOINLINE void store_pixels(const Pixel& pixel, const whole& places, const mask& on, const Canvas<MM_REAL>& canvas)
{
    MM_REAL reals[4][pack_lanes];
    Int wholes[4][pack_lanes];
    Int live[pack_lanes];
    store_lanes(pixel.colour.x, reals[0]);
    store_lanes(pixel.colour.y, reals[1]);
    store_lanes(pixel.colour.z, reals[2]);
    store_lanes(pixel.depth, reals[3]);
    store_lanes(pixel.steps, wholes[0]);
    store_lanes(pixel.estimates, wholes[1]);
    store_lanes(pixel.iterations, wholes[2]);
    store_lanes(places, wholes[3]);
    store_lanes(count(on), live);
    for (int lane = 0; lane < pack_lanes; ++lane) {
        if (live[lane] == 0) continue;
        const Int at = wholes[3][lane];
        for (int plane = 0; plane < 4; ++plane) canvas.reals[plane * canvas.pixels + at] = reals[plane][lane];
        for (int plane = 0; plane < 3; ++plane) {
            canvas.wholes[plane * canvas.pixels + at] = static_cast<int>(wholes[plane][lane]);
        }
    }
}

// Shades all rays of the pool but an incomplete last pack; that one too if `all`.
HWY_NOINLINE void shade_pool(const Scene& scene, Pool& ended, const Canvas<MM_REAL>& canvas, bool all)
{
    int done = 0;
    while (ended.size - done >= pack_lanes || (all && ended.size > done)) {
        Traveller a = load(ended, done);
        const mask on = first_lanes(ended.size - done);
        // Lanes beyond the last ray hit nothing.
        a.ray.last_distance = pick(on, a.ray.last_distance, scene.end);
        store_pixels(shade(scene, a.ray), a.pixel, on, canvas);
        done += pack_lanes;
    }
    if (done == 0) return;
    // The rest goes to the front: less than a pack.
    const int rest = ended.size > done ? ended.size - done : 0;
    Traveller a = load(ended, done);
    ended.size = 0;
    append(ended, a, first_lanes(rest));
}

// One step of refinement for every ray of the pool; those that need no more go to `ended`.
HWY_NOINLINE void refine_pool(const Scene& scene, Pool& pool, Pool& ended, const Canvas<MM_REAL>& canvas)
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
        if (ended.size > pool_rays - pack_lanes) shade_pool(scene, ended, canvas, false);
    }
}

// A pack covers a rectangle of pixels, as square as its lanes allow, so that its rays stay close to each other.
constexpr int rectangle_width()
{
    int width = 1;
    while (width * width < pack_lanes) width *= 2;
    return width;
}
constexpr int pack_width = rectangle_width();
constexpr int pack_height = pack_lanes / pack_width;
static_assert(pack_width <= tile_side && pack_height <= tile_side);

// A pack's coordinates and whether each lane is on the picture.
struct Lanes {
    MM_REAL i[pack_lanes];
    MM_REAL j[pack_lanes];
    MM_REAL inside[pack_lanes];
    MM_REAL start[pack_lanes];  // no ray hits before this t
    Int place[pack_lanes];
    Int estimates[pack_lanes];  // made for it by cones
    Int iterations[pack_lanes];
};

HWY_INLINE whole load_lanes(const Int* from)
{
    whole a;
    for (int u = 0; u < MM_REGISTERS; ++u) a.of[u] = hn::LoadU(Wholes(), from + u * register_lanes);
    return a;
}

HWY_INLINE real load_lanes(const MM_REAL* from)
{
    real a;
    for (int u = 0; u < MM_REGISTERS; ++u) a.of[u] = hn::LoadU(Reals(), from + u * register_lanes);
    return a;
}

// Some tiles, begun together so that their cones fill packs.
constexpr int group_tiles = 8;
struct Group {
    int count;
    int left[group_tiles];
    int bottom[group_tiles];
};

// The blocks of side x side pixels of a group, in the order of tiles, rows and columns.
constexpr int blocks_across(int side) { return tile_side / side; }
constexpr int blocks_of_tile(int side) { return blocks_across(side) * blocks_across(side); }

// Where a group's cones came to. What a cone cost is counted for one of its rays.
template <int side>
struct Cones {
    static constexpr int most = (group_tiles * blocks_of_tile(side) + pack_lanes - 1) / pack_lanes * pack_lanes;
    MM_REAL start[most];
    Int estimates[most];
    Int iterations[most];
};

// Marches one cone for every block of `side` pixels, from where the larger block's cone came to.
template <int side, int parent_side>
HWY_NOINLINE void march_cones(const Scene& scene, const Group& group, scalar pitch, const Cones<parent_side>* parents,
                              Cones<side>& cones)
{
    const int blocks = group.count * blocks_of_tile(side);
    for (int from = 0; from < blocks; from += pack_lanes) {
        Lanes lanes;
        for (int lane = 0; lane < pack_lanes; ++lane) {
            const int block = from + lane < blocks ? from + lane : blocks - 1;
            const int tile = block / blocks_of_tile(side);
            const int x = block % blocks_of_tile(side) % blocks_across(side) * side;
            const int y = block % blocks_of_tile(side) / blocks_across(side) * side;
            constexpr MM_REAL middle = MM_REAL(0.5) * (side - 1);
            lanes.i[lane] = static_cast<MM_REAL>(group.left[tile] + x) + middle;
            lanes.j[lane] = static_cast<MM_REAL>(group.bottom[tile] + y) + middle;
            const int parent =
                tile * blocks_of_tile(parent_side) + y / parent_side * blocks_across(parent_side) + x / parent_side;
            const bool first = x % parent_side == 0 && y % parent_side == 0;
            lanes.start[lane] = parents == nullptr ? MM_REAL(0) : parents->start[parent];
            lanes.estimates[lane] = parents == nullptr || !first ? Int(0) : parents->estimates[parent];
            lanes.iterations[lane] = parents == nullptr || !first ? Int(0) : parents->iterations[parent];
        }
        Ray ray = begin(scene, load_lanes(lanes.i), load_lanes(lanes.j));
        // A ray at the cone's edge may meet the hull before the axis does. An axis that misses it goes nowhere.
        ray.t = load_lanes(lanes.start);
        ray.estimates = load_lanes(lanes.estimates);
        ray.iterations = load_lanes(lanes.iterations);
        ray = march_cone(scene, ray, pitch * (MM_REAL(0.5) * (side - 1)));
        store_lanes(ray.t, cones.start + from);
        store_lanes(ray.estimates, cones.estimates + from);
        store_lanes(ray.iterations, cones.iterations + from);
    }
}

// Begins the rays of tile number `tile` of the group, where its cones of 2 x 2 pixels came to, if there are any.
HWY_NOINLINE void begin_tile(const Scene& scene, const Group& group, int tile, const Canvas<MM_REAL>& canvas,
                             const Cones<2>* cones, Pool& pool)
{
    const int left = group.left[tile];
    const int bottom = group.bottom[tile];
    for (int y0 = bottom; y0 < bottom + tile_side && y0 < canvas.end_row; y0 += pack_height) {
        for (int x0 = left; x0 < left + tile_side && x0 < scene.width; x0 += pack_width) {
            Lanes lanes;
            for (int lane = 0; lane < pack_lanes; ++lane) {
                const int x = x0 + lane % pack_width;
                const int y = y0 + lane / pack_width;
                lanes.i[lane] = static_cast<MM_REAL>(x);
                lanes.j[lane] = static_cast<MM_REAL>(y);
                lanes.place[lane] = static_cast<Int>(y - canvas.first_row) * scene.width + x;
                lanes.inside[lane] = x < scene.width && y < canvas.end_row ? MM_REAL(1) : MM_REAL(0);
                const int block = tile * blocks_of_tile(2) + (y - bottom) / 2 * blocks_across(2) + (x - left) / 2;
                const bool first = x % 2 == 0 && y % 2 == 0;
                lanes.start[lane] = cones == nullptr ? MM_REAL(0) : cones->start[block];
                lanes.estimates[lane] = cones == nullptr || !first ? Int(0) : cones->estimates[block];
                lanes.iterations[lane] = cones == nullptr || !first ? Int(0) : cones->iterations[block];
            }
            Traveller a;
            a.pixel = load_lanes(lanes.place);
            const mask on = load_lanes(lanes.inside) > 0;
            a.ray = begin(scene, load_lanes(lanes.i), load_lanes(lanes.j));
            a.ray.t = larger(a.ray.t, load_lanes(lanes.start));
            a.ray.estimates = load_lanes(lanes.estimates);
            a.ray.iterations = load_lanes(lanes.iterations);
            const mask go = marching(scene, a.ray);
            append(pool, a, on && go);
            if (any(on && !go)) store_pixels(missed(scene, a.ray), a.pixel, on && !go, canvas);
        }
    }
}

// Begins a group's tiles, with cones of 8 and of 2 pixels before the rays.
HWY_NOINLINE void begin_group(const Scene& scene, const Group& group, const Canvas<MM_REAL>& canvas, Pool& pool)
{
    Cones<8> coarse;
    Cones<2> fine;
    const bool with_cones = canvas.pitch > 0;
    if (with_cones) {
        march_cones<8, tile_side>(scene, group, canvas.pitch, nullptr, coarse);
        march_cones<2, 8>(scene, group, canvas.pitch, &coarse, fine);
    }
    for (int tile = 0; tile < group.count; ++tile) {
        begin_tile(scene, group, tile, canvas, with_cones ? &fine : nullptr, pool);
    }
}

// One step of marching for every ray of the pool; hits go on to be refined, or to be shaded where none is.
HWY_NOINLINE void march_pool(const Scene& scene, Pool& pool, Pool& hits, Pool& ended, const Canvas<MM_REAL>& canvas)
{
    const int size = pool.size;
    pool.size = 0;
    for (int from = 0; from < size; from += pack_lanes) {
        Traveller a = load(pool, from);
        const mask on = first_lanes(size - from);
        a.ray = advance(scene, a.ray, on);
        const mask go = marching(scene, a.ray);
        append(pool, a, on && go);
        const mask stays = on && !go;
        if (!any(stays)) continue;
        const mask hit = stays && has_hit(scene, a.ray);
        const mask gone = stays && !hit;
        if (any(gone)) store_pixels(missed(scene, a.ray), a.pixel, gone, canvas);
        if (scene.canonical != 0) {
            a.ray = refine_begin(scene, a.ray);
            const mask coarse = hit && refining(scene, a.ray);
            append(hits, a, coarse);
            append(ended, a, hit && !coarse);
            while (hits.size > pool_rays - pack_lanes) refine_pool(scene, hits, ended, canvas);
        } else {
            append(ended, a, hit);
        }
        if (ended.size > pool_rays - pack_lanes) shade_pool(scene, ended, canvas, false);
    }
}

// A thread's memory.
struct Pools {
    Pool marching;
    Pool hits;   // to be refined
    Pool ended;  // to be shaded
};

// Draws tiles until there are no more.
void draw_tiles(const void* data, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* memory)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    auto& [pool, hits, ended] = *static_cast<Pools*>(memory);
    pool.size = hits.size = ended.size = 0;
    bool more = true;
    while (more || pool.size > 0) {
        while (more && pool.size <= pool_rays - group_tiles * tile_pixels) {
            Group group;
            group.count = 0;
            while (group.count < group_tiles && more) {
                more = tiles.next(tiles.source, group.left[group.count], group.bottom[group.count]);
                group.count += more;
            }
            if (group.count > 0) begin_group(scene, group, canvas, pool);
        }
        march_pool(scene, pool, hits, ended, canvas);
        while (hits.size > pool_rays / 2) refine_pool(scene, hits, ended, canvas);
    }
    while (hits.size > 0) refine_pool(scene, hits, ended, canvas);
    shade_pool(scene, ended, canvas, true);
}
#include "core/kernel/prelude/undefine.h"
#undef EACH_REGISTER
