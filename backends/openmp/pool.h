// One pack width: the prelude, the text, and a scheduler around it that keeps lanes busy. Included in a namespace of
// its own; no guard.
//
// A pool of rays, structure of arrays, is marched one step at a time, and the rays that go on are stored back without
// gaps. Rays that hit wait in a second pool until a whole pack of them can be refined and shaded. When the first pool
// runs low it takes the rays of another tile. No lane waits for a slow neighbour but within one call of the estimator.
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"

#include "backends/openmp/rays.h"

constexpr int steps_at_once = 16;

// The lanes that are on, without gaps.
HWY_INLINE void store_compact(const whole& from, const mask& on, Int* to)
{
    EACH_REGISTER(hn::StoreU(compressed(from.of[u], on.of[u]), Wholes(), to); to += hn::CountTrue(Reals(), on.of[u]);)
}

HWY_INLINE void store_compact(const real& from, const mask& on, MM_REAL* to)
{
    EACH_REGISTER(hn::StoreU(compressed(from.of[u], on.of[u]), Reals(), to); to += hn::CountTrue(Reals(), on.of[u]);)
}

// trunc(255 c), c cut to [0, 1]; 0 where it is not a number.
HWY_INLINE whole byte_of(const real& c)
{
    const real scaled = 255 * smaller(larger(c, 0), 1);
    whole a;
    EACH_REGISTER(a.of[u] = hn::ConvertTo(Wholes(), scaled.of[u]);)
    return a;
}

// A pixel's three bytes in one number, red lowest.
HWY_INLINE whole bytes_of(const vec3& colour)
{
    const whole red = byte_of(colour.x);
    const whole green = byte_of(colour.y);
    const whole blue = byte_of(colour.z);
    whole a;
    EACH_REGISTER(a.of[u] = hn::Or(red.of[u], hn::Or(hn::ShiftLeft<8>(green.of[u]), hn::ShiftLeft<16>(blue.of[u])));)
    return a;
}

// Finished pixels to their places on the canvas.
HWY_NOINLINE void store_pixels(const Pixel& pixel, const whole& places, const mask& on, const Canvas<MM_REAL>& canvas,
                               Spent& spent)
{
    const int lanes = lanes_on(on);
    constexpr int room = pack_lanes + register_lanes;
    Int at[room];
    Int work[whole_planes][room];
    store_compact(places, on, at);
    store_compact(pixel.steps, on, work[0]);
    store_compact(pixel.estimates, on, work[1]);
    store_compact(pixel.iterations, on, work[2]);
    for (int i = 0; i < lanes; ++i) {
        spent.steps += static_cast<std::uint64_t>(work[0][i]);
        spent.estimates += static_cast<std::uint64_t>(work[1][i]);
        spent.iterations += static_cast<std::uint64_t>(work[2][i]);
    }
    if (canvas.bytes != nullptr) {
        Int bytes[room];
        store_compact(bytes_of(pixel.colour), on, bytes);
        for (int i = 0; i < lanes; ++i) {
            unsigned char* to = canvas.bytes + 3 * static_cast<std::ptrdiff_t>(at[i]);
            to[0] = static_cast<unsigned char>(bytes[i]);
            to[1] = static_cast<unsigned char>(bytes[i] >> 8);
            to[2] = static_cast<unsigned char>(bytes[i] >> 16);
        }
        return;
    }
    MM_REAL values[real_planes][room];
    store_compact(pixel.colour.x, on, values[0]);
    store_compact(pixel.colour.y, on, values[1]);
    store_compact(pixel.colour.z, on, values[2]);
    store_compact(pixel.depth, on, values[3]);
    for (int i = 0; i < lanes; ++i) {
        for (int plane = 0; plane < real_planes; ++plane)
            canvas.reals[plane * canvas.pixels + at[i]] = values[plane][i];
        for (int plane = 0; plane < whole_planes; ++plane) {
            canvas.wholes[plane * canvas.pixels + at[i]] = static_cast<int>(work[plane][i]);
        }
    }
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
    // The rest goes to the front: less than a pack.
    const int rest = ended.size > done ? ended.size - done : 0;
    Traveller a = load(ended, done);
    ended.size = 0;
    append(ended, a, first_lanes(rest));
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

// A pack's values, lane by lane.
struct Lanes {
    MM_REAL i[pack_lanes];
    MM_REAL j[pack_lanes];
    MM_REAL start[pack_lanes];  // no ray hits before this t
    Int estimates[pack_lanes];  // made for it by cones
    Int iterations[pack_lanes];
};

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

// Where the cones that are on have come to, to their places.
template <int side>
HWY_NOINLINE void store_cones(const Traveller& a, const mask& on, Cones<side>& cones)
{
    constexpr int room = pack_lanes + register_lanes;
    Int at[room];
    MM_REAL t[room];
    Int work[2][room];
    store_compact(a.pixel, on, at);
    store_compact(a.ray.t, on, t);
    store_compact(a.ray.estimates, on, work[0]);
    store_compact(a.ray.iterations, on, work[1]);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) {
        cones.start[at[i]] = t[i];
        cones.estimates[at[i]] = work[0][i];
        cones.iterations[at[i]] = work[1][i];
    }
}

// Begins one cone for every block of `side` pixels, where the larger block's cone came to.
template <int side, int parent_side>
HWY_NOINLINE void begin_cones(const Scene& scene, const Group& group, const Cones<parent_side>* parents, Pool& pool,
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
        Traveller a;
        a.pixel = lane_numbers() + whole(static_cast<Int>(from));
        a.ray = begin(scene, load_lanes(lanes.i), load_lanes(lanes.j));
        // A ray at the cone's edge may meet the hull before the axis does. An axis that misses it goes nowhere.
        a.ray.t = load_lanes(lanes.start);
        a.ray.estimates = load_lanes(lanes.estimates);
        a.ray.iterations = load_lanes(lanes.iterations);
        const mask on = first_lanes(blocks - from);
        const mask go = on && a.ray.t <= a.ray.end;
        append(pool, a, go);
        store_cones(a, on && !go, cones);
    }
}

// Marches a cone for every block of `side` pixels.
template <int side, int parent_side>
HWY_NOINLINE void march_cones(const Scene& scene, const Group& group, scalar pitch, const Cones<parent_side>* parents,
                              Pool& pool, Cones<side>& cones)
{
    const scalar width = pitch * (MM_REAL(0.5) * (side - 1));
    pool.size = 0;
    begin_cones(scene, group, parents, pool, cones);
    while (pool.size > 0) {
        const int size = pool.size;
        pool.size = 0;
        for (int from = 0; from < size; from += pack_lanes) {
            Traveller a = load(pool, from);
            const mask on = first_lanes(size - from);
            const int enough = lanes_on(on) * 3 / 4;
            mask go = on;
            int step = 0;
            do {
                a.ray = advance_cone(scene, a.ray, width, go);
                go = go && cone_goes(a.ray);
            } while (++step < steps_at_once && lanes_on(go) > enough);
            append(pool, a, go);
            store_cones(a, on && !go, cones);
        }
    }
}

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
        while (more && pool.size <= pool_rays - group_tiles * tile_pixels) {
            Group group;
            group.count = 0;
            while (group.count < group_tiles && more) {
                more = tiles.next(tiles.source, group.left[group.count], group.bottom[group.count]);
                group.count += more;
            }
            if (group.count > 0) begin_group(scene, group, canvas, pool, cones, spent);
        }
        march_pool(scene, pool, hits, ended, canvas, spent);
        while (hits.size > pool_rays / 2) refine_pool(scene, hits, ended, canvas, spent);
    }
    while (hits.size > 0) refine_pool(scene, hits, ended, canvas, spent);
    shade_pool(scene, ended, canvas, spent, true);
    return spent;
}
#include "core/kernel/prelude/undefine.h"
#undef EACH_REGISTER
