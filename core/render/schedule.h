// SPDX-License-Identifier: Apache-2.0
// The schedule of passes for all backends: bands of rows, and the kernel's entry points for each band.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/render/backend.h"

namespace mandelmarch {

// The kernel's entry points. `draw` renders a pixel completely; the others are its stages, on stored rays.
enum class Entry { draw, begin, march, refine, shade };

// Rows [first_row, first_row + rows) of the picture, from the bottom.
struct Band {
    int first_row;
    int rows;
};

// Limits of a device for one pass.
struct Limits {
    std::int64_t pixels_per_band;           // capacity of its buffers
    std::int64_t pixels_to_fill = 1 << 16;  // min pixels of a band that keep the device busy
    std::int64_t loops_per_invocation = 0;  // max loop iterations of an invocation; 0: unlimited
    // Bands begin small and grow towards this duration, so that slow devices can be stopped. 0: equal bands.
    double seconds_per_band = 0;
};

// Max pixels of a band; min pixels of a GPU's band.
inline constexpr std::int64_t largest_band = 1 << 22;
inline constexpr std::int64_t fewest_of_gpu = 1 << 18;
// Multiples of a GPU's resident threads in a band.
inline constexpr std::int64_t waves_of_band = 16;

// Band size, in pixels, for a GPU with `threads` resident threads (0: unknown): so many waves that the tail wave, which
// waits for the slowest ray, is negligible.
inline std::int64_t pixels_of_gpu(std::int64_t threads)
{
    return std::clamp(waves_of_band * threads, fewest_of_gpu, largest_band);
}

// Sets the pixels of a band, up to the device's capacity; `band` 0: unchanged.
inline Limits with_band(Limits limits, int band)
{
    if (band > 0) limits.pixels_per_band = limits.pixels_to_fill = std::min<std::int64_t>(limits.pixels_per_band, band);
    return limits;
}

// True if only the bytes of a picture are needed, without values and work counts.
inline bool bytes_alone(const Image& image, const RendererOptions& options)
{
    return !image.has_values() && !options.counts;
}

// Returns the rows of every band; the last band may have fewer.
int rows_per_band(const Scene& scene, const Limits& limits);

// Runs the schedule's passes on a backend.
class Executor {
public:
    virtual ~Executor() = default;

    // Runs one entry point on every pixel of the band. `steps`: max steps of a ray in this pass for `march`, max
    // refinements for `refine`. May be deferred until marching() or read_back() needs the result.
    virtual void run(Entry entry, const Band& band, int steps) = 0;

    // After `march`: true while a ray of the band has neither hit nor left the scene.
    virtual bool marching(const Band& band) = 0;

    // Copies the band's finished pixels into the image.
    virtual void read_back(const Band& band, Image& image) = 0;
};

// Renders the scene band by band. If one invocation may compute a whole pixel, a band is one `draw` pass; otherwise
// begin, repeated march, repeated refine (fast mode only), and shade.
void run_schedule(const Scene& scene, Mode mode, const Limits& limits, Executor& executor, Image& image,
                  const Progress& progress);

}  // namespace mandelmarch
