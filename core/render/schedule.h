// SPDX-License-Identifier: Apache-2.0
// The schedule of passes, the same for all backends: the picture is divided into bands of rows, and for each band the
// kernel's entry points are called. A backend writes an Executor and calls
//     run_schedule(scene, options.mode, {.pixels_per_band = most}, executor, image, progress);
// It runs, for each band: run(Entry::draw, band, max_steps), then read_back(band, image).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/render/backend.h"
#include "core/render/lattice.h"

namespace mandelmarch {

// The kernel's entry points. `cones` marches a cone for each tile. `draw` renders a pixel completely. The other entry
// points are the stages of `draw`. Between two stages, rays are stored.
enum class Entry { cones, draw, begin, march, refine, shade };

// Rows [first_row, first_row + rows) of the picture, counted from the bottom, and what a pass does in them.
struct Band {
    int first_row;
    int rows;
    Lattice lattice = {0, 1};  // the pixels of a pass that is not of cones
    Cones cones = {};          // the cones of a pass of cones
};

// Max number of iterations that all loops of an invocation, including nested ones, take for a part of its work. The end
// of a loop counts as one more iteration. Loops in branches that are not taken are not counted, although a device that
// masks lanes may execute them once.
struct Loops {
    std::int64_t pass;    // a pass that marches or refines, without its steps or refinements
    std::int64_t step;    // one step of a ray or a cone
    std::int64_t tried;   // one refinement of a hit
    std::int64_t refine;  // all refinements of a hit
    std::int64_t shade;   // shading
};

struct LoopLimit {
    std::int64_t survived;  // max loop iterations of an invocation in a pass that the device survives
    Loops of_scene;         // counted by loops_of() of core/instruments/loops.h
};

// Max steps of a cone, as in core/kernel/stepping.h.
inline constexpr std::int64_t most_cone_steps = 100;

// Returns true if an invocation may march a whole cone.
bool cones_fit(const LoopLimit& limit);

// Limits of a device for a single pass.
struct Limits {
    std::int64_t pixels_per_band;           // max pixels of a band, the capacity of the device's buffers
    std::int64_t pixels_to_fill = 1 << 16;  // min pixels of a band that keep the device busy
    std::optional<LoopLimit> loops{};       // empty: an invocation may loop as often as it needs
    Starts starts = {};                     // the passes that find where rays begin
    // Target seconds of a band: bands begin small and grow until they take that long, so that a picture on a slow
    // device can be cancelled soon. 0: all bands have the same size. Not used with cones or lattices, because pixels
    // then depend on the band's rows, and must not depend on times.
    double seconds_per_band = 0;
};

inline constexpr std::int64_t largest_band = 1 << 22;  // max pixels of any band

// Returns the pixels of a band for a GPU with `threads` resident threads (0: unknown, or a watchdog ends long kernels).
// A band has 16 waves of threads. With fewer, the last wave, in which most threads wait for the slowest ray, would take
// a large part of the time. With more, a slow GPU could be cancelled only after seconds, or its watchdog could end the
// band, and little would be saved: a 4K picture on a GPU of 30,000 threads has 17 bands, whose 70 launches take about a
// millisecond. On GPUs of over 260,000 threads a band has largest_band pixels.
constexpr std::int64_t pixels_of_gpu(std::int64_t threads)
{
    constexpr std::int64_t waves = 16;
    constexpr std::int64_t fewest = 1 << 18;
    return std::clamp(waves * threads, fewest, largest_band);
}

// Returns the limits with bands of `band` pixels, but at most the device's capacity. If `band` is 0, the limits are
// unchanged.
inline Limits with_band(Limits limits, int band)
{
    if (band > 0) limits.pixels_per_band = limits.pixels_to_fill = std::min<std::int64_t>(limits.pixels_per_band, band);
    return limits;
}

// Returns true if only the bytes of a picture are needed, neither values nor work counts.
inline bool bytes_alone(const Image& image, const RendererOptions& options)
{
    return !image.has_values() && !options.counts;
}

// Returns the number of rows of each band; the last band may have fewer.
int rows_per_band(const Scene& scene, const Limits& limits);

// Executes the passes of a schedule. Each backend implements it.
class Executor {
public:
    virtual ~Executor() = default;

    // Runs an entry point on every tile of the band's cones, or on every pixel of its lattice. For `march`, `steps` is
    // the max number of steps of a ray in this pass; for `refine`, it is the max number of refinements of a hit. May
    // return before the device has finished; marching() and read_back() wait for it.
    virtual void run(Entry entry, const Band& band, int steps) = 0;

    // Called after `march`. Returns true while any ray of the band has neither hit nor left the scene.
    virtual bool marching(const Band& band) = 0;

    // Copies the finished pixels of the band into the image.
    virtual void read_back(const Band& band, Image& image) = 0;
};

// Renders the scene band by band. A band's cones come first, then its lattices one after the other. If an invocation
// may compute a whole pixel, a lattice is rendered by one pass of `draw`. Otherwise the passes of a lattice are: one of
// `begin`; `march` until all rays have stopped; in fast mode `refine`; one of `shade`.
void run_schedule(const Scene& scene, Mode mode, const Limits& limits, Executor& executor, Image& image,
                  const Progress& progress);

}  // namespace mandelmarch
