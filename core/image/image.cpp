#include "core/image/image.h"

namespace mandelmarch {

Image::Image(int width, int height, Layers layers) : width_(width), height_(height)
{
    bytes_.resize(3 * pixels());
    if (layers == Layers::all) values_.resize(pixels());
}

std::size_t Image::bytes_per_pixel(Layers layers) { return layers == Layers::all ? 3 + sizeof(PixelValue) : 3; }

template <class Real>
void Image::store(const Tile<Real>& tile, int left, int bottom, int width, int height)
{
    const auto byte = [](Real c) { return static_cast<std::uint8_t>(255 * c); };
    for (int y = 0; y < height; ++y) {
        const std::size_t row = static_cast<std::size_t>(bottom + y) * static_cast<std::size_t>(width_);
        for (int x = 0; x < width; ++x) {
            const int from = y * tile_side + x;
            const std::size_t to = row + static_cast<std::size_t>(left + x);
            bytes_[3 * to] = byte(tile.red[from]);
            bytes_[3 * to + 1] = byte(tile.green[from]);
            bytes_[3 * to + 2] = byte(tile.blue[from]);
            if (!has_values()) continue;
            values_[to] = {tile.red[from],   tile.green[from], tile.blue[from],
                           tile.depth[from], tile.steps[from], tile.iterations[from]};
        }
    }
}

template void Image::store(const Tile<float>&, int, int, int, int);
template void Image::store(const Tile<double>&, int, int, int, int);

}  // namespace mandelmarch
