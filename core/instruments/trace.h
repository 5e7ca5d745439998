// SPDX-License-Identifier: Apache-2.0
// Traces one pixel's ray step by step with the scalar kernel (the kernel in plain C++, one pixel at a time).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/render/kernel_scene.h"

namespace mandelmarch {

// The decision that marching or refinement makes at a sample.
enum class Decision {
    step,          // the ray continues
    taken_back,    // the step to this sample was too long; the ray continues from the previous sample
    hit,           // DE is below the tolerance
    left,          // the next sample would lie beyond the ray's end
    out_of_steps,  // the ray has had the maximum number of samples
    undecided,     // DE equals the tolerance, or one of the two is NaN; the ray ends without a hit
    root_below,    // refinement: DE is below the tolerance here
    root_above     // refinement: DE is not below the tolerance here
};

// The reason why refinement ended.
enum class Refined {
    never,        // the hit was not refined: exact mode, no hit, or no sample before the hit
    close,        // DE is close enough to the tolerance, or the bracket is short enough
    no_number,    // the bracket's ends are adjacent floating-point numbers
    out_of_roots  // the maximum number of DE evaluations was made
};

// One sample of a ray. Lengths are in the scene's units. `tolerance` is the tolerance used for the decision; for a
// sample that is taken back, it is the tolerance at the previous sample.
struct TracedSample {
    double t, distance, tolerance;
    Decision decision;
    double next;         // while marching: t of the next sample
    int iterations = 0;  // iterations in the DE evaluation; if the scene's maximum, the orbit has not escaped
};

struct Trace {
    Precision precision;
    Mode mode;
    int x, y;            // pixels from the bottom left
    int width, height;   // pixels; size of the picture
    double step_factor;  // length of a plain step, in distance estimates
    double relaxation;   // largest step factor; steps are relaxed only if it exceeds `step_factor`
    std::array<double, 3> direction;
    double begin, end;  // t of the first sample, and the largest t of a sample; no samples if end < begin
    std::vector<TracedSample> marching, refining;
    Refined refined = Refined::never;
    bool hit = false;
    std::optional<std::array<double, 3>> normal;  // set if the ray hits
    PixelValue pixel;
    std::array<std::uint8_t, 3> bytes{};
    int de_calls = 0;  // DE evaluations, including those for refinement, normal and look
};

// Traces the ray of pixel (x, y), which must lie in the picture. In exact mode the pixel has the same bits as on every
// backend. In fast mode the ray uses neither cones nor neighbours, as in pictures of openmp's scalar kernel with
// `--without cones,neighbours`, and the step factor is that of the scene, without a trial. Throws InputError as
// kernel_scene() does, and Unavailable if this build does not contain the fractal.
Trace trace_pixel(const Scene& scene, const RendererOptions& options, int x, int y);

// Returns the trace as text: one line per sample, then the result. Numbers have so many digits that their bits can be
// recovered.
std::string text_of(const Trace& trace);

// A function that traces the ray of pixel (trace.x, trace.y) and fills in the rest of `trace`.
template <class Real>
using TracePixel = void(const KernelScene<Real>& scene, Trace& trace);

// Returns the function for a variant (variant_name()); nullptr if this build does not contain the fractal.
// cmake/Kernels.cmake generates these functions from trace.cpp.in.
template <class Real>
TracePixel<Real>* pixel_tracer(std::string_view variant);

}  // namespace mandelmarch
