// One pack width: the prelude, the text and a tile's loop over packs. Included in a namespace of its own; no guard.
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"

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

// Lanes of a pack in memory, lane 0 first.
HWY_INLINE void store_lanes(real from, MM_REAL* to)
{
    for (int u = 0; u < MM_REGISTERS; ++u) hn::StoreU(from.of[u], Reals(), to + u * register_lanes);
}

HWY_INLINE void store_lanes(whole from, Int* to)
{
    for (int u = 0; u < MM_REGISTERS; ++u) hn::StoreU(from.of[u], Wholes(), to + u * register_lanes);
}

HWY_INLINE real load_lanes(const MM_REAL* from)
{
    real to;
    for (int u = 0; u < MM_REGISTERS; ++u) to.of[u] = hn::LoadU(Reals(), from + u * register_lanes);
    return to;
}

// The lanes of a finished pack, pixel by pixel into the tile, its bottom left at (x0, y0) of the tile.
HWY_INLINE void store_pixels(const Pixel& pixel, int x0, int y0, Tile<MM_REAL>& tile)
{
    const auto scatter = [&](auto from, auto* lanes, auto* to) HWY_ATTR {
        store_lanes(from, lanes);
        for (int lane = 0; lane < pack_lanes; ++lane) {
            const int at = (y0 + lane / pack_width) * tile_side + x0 + lane % pack_width;
            to[at] = static_cast<decltype(to[0] + 0)>(lanes[lane]);
        }
    };
    MM_REAL reals[pack_lanes];
    scatter(pixel.colour.x, reals, tile.red);
    scatter(pixel.colour.y, reals, tile.green);
    scatter(pixel.colour.z, reals, tile.blue);
    scatter(pixel.depth, reals, tile.depth);
    Int wholes[pack_lanes];
    scatter(pixel.steps, wholes, tile.steps);
    scatter(pixel.estimates, wholes, tile.estimates);
    scatter(pixel.iterations, wholes, tile.iterations);
}

void draw_tile(const void* data, int left, int bottom, Tile<MM_REAL>& tile)
{
    const Scene& scene = *static_cast<const Scene*>(data);
    for (int y0 = 0; y0 < tile_side && bottom + y0 < scene.height; y0 += pack_height) {
        for (int x0 = 0; x0 < tile_side && left + x0 < scene.width; x0 += pack_width) {
            // Lanes beyond the picture's edge draw its last pixel once more; the image does not take them.
            MM_REAL i[pack_lanes];
            MM_REAL j[pack_lanes];
            for (int lane = 0; lane < pack_lanes; ++lane) {
                const int x = left + x0 + lane % pack_width;
                const int y = bottom + y0 + lane / pack_width;
                i[lane] = static_cast<MM_REAL>(x < scene.width ? x : scene.width - 1);
                j[lane] = static_cast<MM_REAL>(y < scene.height ? y : scene.height - 1);
            }
            store_pixels(draw(scene, load_lanes(i), load_lanes(j)), x0, y0, tile);
        }
    }
}
#include "core/kernel/prelude/undefine.h"
#undef EACH_REGISTER
