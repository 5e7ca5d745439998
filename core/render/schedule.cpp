#include "core/render/schedule.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/image/tile.h"
#include "core/render/kernel_scene.h"

namespace mandelmarch {
namespace {

// Enough bands to show progress, each large enough to keep a device busy.
constexpr std::int64_t bands_wanted = 64;

// The estimates of a pass that shades (central differences), and the steps of a hit that is refined to its end: as
// in the kernel text.
constexpr std::int64_t shade_estimates = 6;
constexpr std::int64_t look_estimates = 12;  // more of them in our own looks, the orbit trap and its colours included
constexpr std::int64_t refine_steps = 100;

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

int rows_per_band(const Scene& scene, const Limits& limits)
{
    const std::int64_t width = scene.width;
    const std::int64_t wanted =
        std::clamp(width * scene.height / bands_wanted, std::min(limits.pixels_to_fill, limits.pixels_per_band),
                   limits.pixels_per_band);
    // Whole tiles where the limits allow it.
    std::int64_t rows = std::clamp<std::int64_t>(wanted / width, 1, scene.height);
    if (rows > tile_side) rows = rows / tile_side * tile_side;
    return static_cast<int>(rows);
}

void run_schedule(const Scene& scene, Mode mode, const Limits& limits, Executor& executor, Image& image,
                  const Progress& progress)
{
    // An estimate loops once for each of its iterations; a loop may be counted once more, when it ends.
    const std::int64_t loops_per_step = std::int64_t{scene.iterations} + 2;
    const std::int64_t shading = shade_estimates + (scene.colouring > 1 ? look_estimates : 0);
    const std::int64_t estimates = max_steps + refine_steps + shading;
    const bool whole = limits.loops_per_invocation == 0 || loops_per_step * estimates <= limits.loops_per_invocation;
    const auto steps_per_pass =
        static_cast<int>(std::clamp<std::int64_t>(limits.loops_per_invocation / loops_per_step - 1, 1, max_steps));

    if (limits.loops_per_invocation > 0 && shading * loops_per_step > limits.loops_per_invocation) {
        throw Unavailable(fmt::format(
            "colouring type {} with {} iterations loops more often than this device survives, expected fewer "
            "iterations or the types 0 and 1",
            scene.colouring, scene.iterations));
    }

    const int rows = rows_per_band(scene, limits);
    for (int row = 0; row < scene.height; row += rows) {
        const Band band{row, std::min(rows, scene.height - row)};
        if (whole) {
            executor.run(Entry::draw, band, max_steps);
        } else {
            executor.run(Entry::begin, band, 0);
            do {
                executor.run(Entry::march, band, steps_per_pass);
            } while (executor.marching(band));
            for (int done = 0; mode == Mode::fast && done < refine_steps; done += steps_per_pass) {
                executor.run(Entry::refine, band, std::min<int>(steps_per_pass, refine_steps - done));
            }
            executor.run(Entry::shade, band, 0);
        }
        executor.read_back(band, image);
        if (progress) progress(static_cast<double>(row + band.rows) / scene.height);
    }
}

}  // namespace mandelmarch
