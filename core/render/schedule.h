// SPDX-License-Identifier: Apache-2.0
// The schedule of passes, the same for every backend: bands of rows, and the kernel text's entries over each band.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/render/backend.h"

namespace mandelmarch {

// The kernel text's entry points. `draw` is a whole pixel in one go; the others are its parts, over stored rays.
enum class Entry { draw, begin, march, refine, shade };

// Rows [first_row, first_row + rows) of the picture, from the bottom.
struct Band {
    int first_row;
    int rows;
};

// What a device can do in one go.
struct Limits {
    std::int64_t pixels_per_band;           // what its buffers hold
    std::int64_t pixels_to_fill = 1 << 16;  // with fewer pixels in a band the device is not busy
    std::int64_t loops_per_invocation = 0;  // rounds of loops that one invocation survives; 0: any number
    // Bands begin small and grow until each takes about this time, so that slow devices can be stopped. 0: equal bands.
    double seconds_per_band = 0;
};

// A band's pixels at most; a GPU's at least.
inline constexpr std::int64_t largest_band = 1 << 22;
inline constexpr std::int64_t fewest_of_gpu = 1 << 18;
// Of threads that a GPU holds, in a band.
inline constexpr std::int64_t waves_of_band = 16;

// Pixels that keep a GPU busy that holds so many threads at once, 0: it does not tell. They are enough waves of those
// threads that the last one, which waits for the slowest ray, does not count.
inline std::int64_t pixels_of_gpu(std::int64_t threads)
{
    return std::clamp(waves_of_band * threads, fewest_of_gpu, largest_band);
}

// With bands of so many pixels where that is not 0; not more than the device holds.
inline Limits with_band(Limits limits, int band)
{
    if (band > 0) limits.pixels_per_band = limits.pixels_to_fill = std::min<std::int64_t>(limits.pixels_per_band, band);
    return limits;
}

// True where nothing but a picture's bytes is asked for: neither the values that they came from nor what they cost.
inline bool bytes_alone(const Image& image, const RendererOptions& options)
{
    return !image.has_values() && !options.counts;
}

// The rows of every band but the last, which may have fewer.
int rows_per_band(const Scene& scene, const Limits& limits);

// A backend's side of the schedule.
class Executor {
public:
    virtual ~Executor() = default;

    // Runs one entry on every pixel of the band. `steps`: the most steps of a ray in this pass, for `march`, and the
    // most roots tried, for `refine`. May be put off until marching() or read_back() asks for what came of it.
    virtual void run(Entry entry, const Band& band, int steps) = 0;

    // After `march`: true while a ray of the band has neither hit nor left.
    virtual bool marching(const Band& band) = 0;

    // Takes the band's finished pixels into the image.
    virtual void read_back(const Band& band, Image& image) = 0;
};

// Draws the scene band by band. Where one invocation survives a whole pixel, a band is one `draw` pass; elsewhere it is
// begin, march as often as needed, refine (in fast mode, as often as needed) and shade.
void run_schedule(const Scene& scene, Mode mode, const Limits& limits, Executor& executor, Image& image,
                  const Progress& progress);

}  // namespace mandelmarch
