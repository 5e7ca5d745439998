#include "core/render/schedule.h"

#include <algorithm>
#include <bit>

#include "core/image/tile.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

// Enough bands to show progress, each large enough to keep a device busy.
constexpr std::int64_t bands_wanted = 64;

// Loop iterations of one estimate: its own, and in each those that raise to a whole power: three loops for the highest
// bit of the exponent and three over its bits.
std::int64_t loops_per_estimate(const Scene& scene)
{
    const auto bits = std::bit_width(static_cast<unsigned>(scene.fractal->constants(scene, 1e37).exponent));
    return std::int64_t{scene.iterations} * (1 + 6 * bits);
}

}  // namespace

template <class Real>
void add_work(Work& work, const Planes<Real>& planes, int width, int height)
{
    for (int y = 0; y < height; ++y) {
        const std::size_t row = static_cast<std::size_t>(y) * planes.stride;
        for (std::size_t at = row; at < row + static_cast<std::size_t>(width); ++at) {
            work.steps += static_cast<std::uint64_t>(planes.steps[at]);
            work.estimates += static_cast<std::uint64_t>(planes.estimates[at]);
            work.iterations += static_cast<std::uint64_t>(planes.iterations[at]);
        }
    }
}

template void add_work(Work&, const Planes<float>&, int, int);
template void add_work(Work&, const Planes<double>&, int, int);

void run_schedule(const Scene& scene, Mode mode, const Limits& limits, Executor& executor, Image& image,
                  const Progress& progress)
{
    const std::int64_t width = scene.width;
    const std::int64_t wanted =
        std::clamp(width * scene.height / bands_wanted, std::min(limits.pixels_to_fill, limits.pixels_per_band),
                   limits.pixels_per_band);
    // Whole tiles where the limits allow it.
    std::int64_t rows = std::max<std::int64_t>(1, wanted / width);
    if (rows > tile_side) rows = rows / tile_side * tile_side;

    std::int64_t steps_per_pass = 0;
    if (limits.loops_per_invocation > 0) {
        steps_per_pass = std::max<std::int64_t>(1, limits.loops_per_invocation / (1 + loops_per_estimate(scene)));
    }
    for (std::int64_t row = 0; row < scene.height; row += rows) {
        const Band band{static_cast<int>(row), static_cast<int>(std::min(rows, scene.height - row))};
        if (steps_per_pass == 0) {
            executor.run(Entry::draw, band, 0);
        } else {
            executor.run(Entry::begin, band, 0);
            do {
                executor.run(Entry::march, band, static_cast<int>(std::min<std::int64_t>(steps_per_pass, 1 << 20)));
            } while (executor.marching(band));
            if (mode == Mode::fast) executor.run(Entry::refine, band, 0);
            executor.run(Entry::shade, band, 0);
        }
        executor.read_back(band, image);
        if (progress) progress(static_cast<double>(row + band.rows) / scene.height);
    }
}

}  // namespace mandelmarch
