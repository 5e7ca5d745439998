// SPDX-License-Identifier: Apache-2.0
// Subtiles: blocks of 8 x 8 pixels whose rays begin together.

constexpr int block_pixels = subtile_side * subtile_side;
constexpr int tile_blocks = tile_pixels / block_pixels;
constexpr int most_blocks = 32;  // max number of subtiles that begin together, enough for their cones to fill packs

struct Blocks {
    int count = 0;
    Int left[most_blocks + register_lanes] = {};  // padded, because whole registers are read and written
    Int bottom[most_blocks + register_lanes] = {};
    Int number[most_blocks + register_lanes] = {};  // index in Canvas::block_start
    int tiles = 0;
    int tile_left[most_blocks];
    int tile_bottom[most_blocks];
};

HWY_INLINE std::ptrdiff_t block_number(const Drawing& d, int x, int y)
{
    const std::ptrdiff_t across = (d.scene.width + subtile_side - 1) / subtile_side;
    return (y - d.canvas.first_row) / subtile_side * across + x / subtile_side;
}

// Takes tiles from the queue and appends their subtiles while a whole tile fits. Returns false if the queue is empty.
HWY_INLINE bool take_tiles(const Drawing& d, Blocks& blocks)
{
    while (blocks.count + tile_blocks <= most_blocks) {
        int left = 0;
        int bottom = 0;
        if (!d.tiles.next(d.tiles.source, left, bottom)) return false;
        blocks.tile_left[blocks.tiles] = left;
        blocks.tile_bottom[blocks.tiles++] = bottom;
        for (int y = bottom; y < bottom + tile_side && y < d.canvas.end_row; y += subtile_side) {
            for (int x = left; x < left + tile_side && x < d.scene.width; x += subtile_side) {
                blocks.left[blocks.count] = x;
                blocks.bottom[blocks.count] = y;
                blocks.number[blocks.count] = static_cast<Int>(block_number(d, x, y));
                ++blocks.count;
            }
        }
    }
    return true;
}

// A row of a subtile in one colour.
struct PaintedRow {
    unsigned char bytes[3 * subtile_side];

    HWY_INLINE explicit PaintedRow(const vec3& colour)
    {
        const auto pixel = static_cast<std::uint32_t>(hn::GetLane(bytes_of(colour).of[0]));
        for (int i = 0; i < 3 * subtile_side; ++i) bytes[i] = static_cast<unsigned char>(pixel >> 8 * (i % 3));
    }
};

HWY_INLINE void paint(const Drawing& d, Int left, Int bottom, const PaintedRow& row)
{
    const std::ptrdiff_t across = d.scene.width;
    const std::ptrdiff_t columns = across - left < subtile_side ? across - left : subtile_side;
    const std::ptrdiff_t rows = d.canvas.end_row - bottom < subtile_side ? d.canvas.end_row - bottom : subtile_side;
    unsigned char* to = d.canvas.bytes + 3 * ((bottom - d.canvas.first_row) * across + left);
    for (std::ptrdiff_t j = 0; j < rows; ++j) {
        __builtin_memcpy(to + 3 * j * across, row.bytes, static_cast<std::size_t>(3 * columns));
    }
}

// Returns true if a subtile without hits can be painted without rays: the background has a single colour, and the
// picture stores only bytes.
HWY_INLINE bool paints_background(const Drawing& d) { return d.canvas.bytes != nullptr && has_look(d.scene) == 0; }
