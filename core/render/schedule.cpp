// SPDX-License-Identifier: Apache-2.0
#include "core/render/schedule.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/image/tile.h"
#include "core/os/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

// Number of bands into which a large picture is divided. There are enough bands to show progress, and each is large
// enough to keep a device busy.
constexpr std::int64_t bands_wanted = 64;
// For bands whose size is determined by time: the pixels of the first band, and the max ratio of a band to the one
// before.
constexpr std::int64_t first_band = 1 << 14;
constexpr double most_growth = 4;

// The part of a pixel that one invocation of the kernel may compute.
struct Plan {
    bool whole = true;      // an invocation may compute a whole pixel; if false, the limits below apply
    int steps = max_steps;  // max marching steps per pass
    int tries = 0;          // max refinements per pass
    int all_tries = 0;      // max refinements of a hit, over all passes
};

// Returns the loop iterations to plan for: half of the device's limit. The other half is a margin for iterations that
// Loops does not count.
std::int64_t planned_of(const LoopLimit& limit) { return limit.survived / 2; }

Plan plan_of(const Scene& scene, Mode mode, const std::optional<LoopLimit>& limit)
{
    Plan plan;
    if (!limit) return plan;
    const std::int64_t survived = limit->survived;
    const Loops& loops = limit->of_scene;
    if (loops.shade > survived) {
        throw Unavailable(fmt::format(
            "colouring type {} with {} iterations loops more often than this device survives, expected fewer "
            "iterations or the types 0 and 1",
            scene.colouring, scene.iterations));
    }
    const std::int64_t planned = planned_of(*limit);
    const std::int64_t refining = mode == Mode::fast ? loops.refine : 0;
    const auto fit = [&](std::int64_t each, std::int64_t most) {
        return static_cast<int>(std::clamp<std::int64_t>((planned - loops.pass) / each, 1, most));
    };
    plan.whole = loops.pass + max_steps * loops.step + refining + loops.shade <= planned;
    plan.steps = fit(loops.step, max_steps);
    plan.all_tries = static_cast<int>((loops.refine - loops.pass) / loops.tried);
    plan.tries = fit(loops.tried, plan.all_tries);
    return plan;
}

// Renders the pixels of a band's lattice. Calls `report` between passes.
template <class Report>
void draw_lattice(const Plan& plan, Mode mode, const Band& band, Executor& executor, const Report& report)
{
    if (plan.whole) {
        executor.run(Entry::draw, band, max_steps);
        return;
    }
    executor.run(Entry::begin, band, 0);
    do {
        report();
        executor.run(Entry::march, band, plan.steps);
    } while (executor.marching(band));
    for (int done = 0; mode == Mode::fast && done < plan.all_tries; done += plan.tries) {
        executor.run(Entry::refine, band, std::min(plan.tries, plan.all_tries - done));
    }
    executor.run(Entry::shade, band, 0);
}

}  // namespace

bool cones_fit(const LoopLimit& limit)
{
    return limit.of_scene.pass + most_cone_steps * limit.of_scene.step <= planned_of(limit);
}

int rows_per_band(const Scene& scene, const Limits& limits)
{
    const std::int64_t width = scene.width;
    const std::int64_t wanted =
        std::clamp(width * scene.height / bands_wanted, std::min(limits.pixels_to_fill, limits.pixels_per_band),
                   limits.pixels_per_band);
    // A band consists of whole rows of tiles, if the limits allow it and the picture has several bands.
    std::int64_t rows = std::clamp<std::int64_t>(wanted / width, 1, scene.height);
    if (rows > tile_side && rows < scene.height) rows = rows / tile_side * tile_side;
    return static_cast<int>(rows);
}

void run_schedule(const Scene& scene, Mode mode, const Limits& limits, Executor& executor, Image& image,
                  const Progress& progress)
{
    const Plan plan = plan_of(scene, mode, limits.loops);
    const int rows = rows_per_band(scene, limits);
    const Starts& starts = limits.starts;
    const bool by_time = limits.seconds_per_band > 0 && !has_starts(starts);
    int next = by_time ? static_cast<int>(std::clamp<std::int64_t>(first_band / scene.width, 1, rows)) : rows;
    const auto share = [&](int row) { return static_cast<double>(row - image.first_row()) / image.height(); };
    for (int row = image.first_row(); row < image.end_row();) {
        const Clock::time_point start = Clock::now();
        Band band{row, std::min(next, image.end_row() - row)};
        for (int pass = 0; pass < starts.cone_passes; ++pass) {
            band.cones = starts.cones[pass];
            executor.run(Entry::cones, band, 0);
        }
        for (const Lattice& lattice : starts.lattices) {
            band.lattice = lattice;
            // Reports progress, and stops if the picture is cancelled, because a band may take many passes.
            draw_lattice(plan, mode, band, executor, [&] {
                if (progress) progress(share(row));
            });
        }
        executor.read_back(band, image);
        row += band.rows;
        if (progress) progress(share(row));
        if (by_time) {
            const double growth = std::min(limits.seconds_per_band / seconds_since(start), most_growth);
            next = std::clamp(static_cast<int>(growth * band.rows), 1, rows);
        }
    }
}

}  // namespace mandelmarch
