// SPDX-License-Identifier: Apache-2.0
#include "core/render/region.h"

#include <algorithm>

#include "core/image/tile.h"

namespace mandelmarch {
namespace {

constexpr int pixels_of_strip = 1 << 22;  // max pixels of a strip that is cropped; a row of tiles is always allowed

// Returns the number of rows that are rendered at a time.
int rows_of_strip(const Scene& scene, const Region& region)
{
    if (region.width == scene.width) return region.height;
    const int rows = std::max(pixels_of_strip / scene.width / tile_side, 1) * tile_side;
    return std::min(rows, region.height);
}

void cut_out(const Image& strip, const Region& region, Image& image)
{
    const std::size_t width = Image::pixels(region.width, 1);
    for (int y = 0; y < strip.height(); ++y) {
        const std::size_t from = Image::pixels(strip.width(), y) + static_cast<std::size_t>(region.left);
        const std::size_t to = Image::pixels(region.width, strip.first_row() + y - region.bottom);
        std::copy_n(strip.bytes().data() + 3 * from, 3 * width, image.bytes().data() + 3 * to);
        if (strip.has_values()) std::copy_n(strip.values().data() + from, width, image.values().data() + to);
    }
}

}  // namespace

std::size_t pixels_in_memory(const Scene& scene, const Region& region)
{
    const std::size_t pixels = Image::pixels(region.width, region.height);
    return region.width == scene.width ? pixels : pixels + Image::pixels(scene.width, rows_of_strip(scene, region));
}

std::pair<Image, RenderStats> render_region(Renderer& renderer, const Scene& scene, const Region& region,
                                            Image::Layers layers, const Progress& progress)
{
    const int rows = rows_of_strip(scene, region);
    const bool whole_rows = region.width == scene.width;
    std::pair<Image, RenderStats> result;
    auto& [image, report] = result;
    if (!whole_rows) image = Image(region.width, region.height, layers);
    Scene drawn = scene;
    for (int done = 0; done < region.height; done += rows) {
        const int now = std::min(rows, region.height - done);
        Image strip(scene.width, now, layers, std::pmr::get_default_resource(), region.bottom + done);
        const RenderStats one = renderer.render(drawn, strip, [&](double share) {
            if (progress) progress((done + share * now) / region.height);
        });
        if (done == 0) {
            report = one;
            // The trial of the first strip serves all.
            if (one.step_factor > 0) drawn.limits = {one.step_factor, scene.limits.root_share, true};
        } else {
            report.timings += one.timings;
            report.work += one.work;
        }
        if (whole_rows) {
            image = std::move(strip);
        } else {
            cut_out(strip, region, image);
        }
    }
    return result;
}

}  // namespace mandelmarch
