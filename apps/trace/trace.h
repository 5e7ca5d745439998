// SPDX-License-Identifier: Apache-2.0
// One pixel's ray, step by step: the kernel text as scalar C++, one step at a time.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/render/backend.h"

namespace mandelmarch {

// What was decided at a sample.
enum class Decision {
    step,          // the ray goes on
    taken_back,    // the step to here was too long: the ray goes on from the sample before
    hit,           // DE is below the tolerance
    left,          // the next sample would lie beyond the ray's end
    out_of_steps,  // the ray has had all its samples
    undecided,     // DE equals the tolerance, or one of the two is not a number: the ray ends without a hit
    root_below,    // refining: DE is below the tolerance here
    root_above
};

// Why refining ended.
enum class Refined {
    never,      // the plain schedule does not refine, or there is no hit or no sample before it
    close,      // DE is near enough to the tolerance, or the bracket is short enough
    no_number,  // no number is left between the bracket's ends
    out_of_roots
};

// Lengths are in the scene's units. `tolerance` is the one that decided; where a sample is taken back, that of the
// sample before.
struct TracedSample {
    double t, distance, tolerance;
    Decision decision;
    double next;         // t of the sample that follows while marching
    int iterations = 0;  // of its estimate; if this is the scene's maximum, the orbit has not escaped
};

struct Trace {
    Precision precision;
    Mode mode;
    int x, y;           // pixels from the bottom left
    int width, height;  // of the picture
    double stride;      // in estimates, of a plain step
    double relaxation;  // of the longest relaxed step; not above the stride: there are none
    std::array<double, 3> direction;
    double begin, end;  // the first sample's t, and the t beyond which there is none; a negative end: none at all
    std::vector<TracedSample> marching, refining;
    Refined refined = Refined::never;
    bool hit = false;
    std::optional<std::array<double, 3>> normal;  // of a hit
    PixelValue pixel;
    std::array<std::uint8_t, 3> bytes{};
    int estimates = 0;  // those of refining, normal and look included
};

// The ray of pixel (x, y), which lies in the picture. In exact mode the pixel has the bits that every backend draws.
// In fast mode the ray begins alone, as openmp's scalar pictures do, and the stride is the scene's: no trial is made.
// Throws InputError as kernel_scene does, and Unavailable for a fractal that it does not know.
Trace trace_pixel(const Scene& scene, const RendererOptions& options, int x, int y);

// The trace for the user: a line a sample, then the result. Numbers have the digits that tell their bits.
std::string text_of(const Trace& trace);

}  // namespace mandelmarch
