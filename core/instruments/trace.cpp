// SPDX-License-Identifier: Apache-2.0
#include "core/instruments/trace.h"

#include <fmt/format.h>

#include "core/scene/fractal.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

// Returns the shortest decimal number that has the same bits as the value in the trace's precision.
std::string number(const Trace& trace, double value)
{
    return trace.precision == Precision::f32 ? fmt::format("{}", static_cast<float>(value)) : fmt::format("{}", value);
}

std::string three(const Trace& trace, const std::array<double, 3>& v)
{
    return fmt::format("{} {} {}", number(trace, v[0]), number(trace, v[1]), number(trace, v[2]));
}

std::string line_of(const Trace& trace, std::string_view first, std::string_view t, std::string_view distance,
                    std::string_view tolerance, std::string_view decided)
{
    const int width = trace.precision == Precision::f32 ? 16 : 25;
    return fmt::format("{:>6}  {:<{}}{:<{}}{:<{}}{}\n", first, t, width, distance, width, tolerance, width, decided);
}

std::string line_of(const Trace& trace, std::size_t index, const TracedSample& sample, const std::string& decided)
{
    return line_of(trace, std::to_string(index + 1), number(trace, sample.t), number(trace, sample.distance),
                   number(trace, sample.tolerance), decided);
}

// Describes in words what the ray does after a sample. `from`: the sample from which the ray continues. It is this
// sample or, if the step to this sample is taken back, an earlier sample.
std::string decided(const Trace& trace, const TracedSample& sample, const TracedSample& from)
{
    std::string step = fmt::format("step of {:.4g} DE", (sample.next - from.t) / from.distance);
    switch (sample.decision) {
        case Decision::step: return step;
        case Decision::taken_back:
            return fmt::format("taken back, as the spheres do not overlap: from t {}, {}", number(trace, from.t), step);
        case Decision::hit: return "hit: DE is below the tolerance";
        case Decision::left:
            return fmt::format("left the scene: the next t, {}, is beyond its end", number(trace, sample.next));
        case Decision::out_of_steps: return "out of steps";
        case Decision::root_below: return "root tried: below the surface";
        case Decision::root_above: return "root tried: above the surface";
        default: return "ends without a hit: DE is the tolerance, or not a number";
    }
}

std::string_view words(Refined refined)
{
    switch (refined) {
        case Refined::close: return "done: near enough";
        case Refined::no_number: return "done: no number is left between the ends";
        case Refined::out_of_roots: return "ended: the maximum number of samples was reached";
        default: return "";
    }
}

std::string head(const Trace& trace)
{
    std::string text =
        fmt::format("pixel {},{} of {} x {}, from the bottom left; {}, {}; by the scalar kernel\n", trace.x, trace.y,
                    trace.width, trace.height, name_of(trace.precision), name_of(trace.mode));
    text += fmt::format("step factor {}", number(trace, trace.step_factor));
    if (trace.relaxation > trace.step_factor)
        text += fmt::format(", relaxed up to {}", number(trace, trace.relaxation));
    text += fmt::format("\ndirection {}\n", three(trace, trace.direction));
    if (trace.end < trace.begin) return text + "no sample: the ray misses the scene\n";
    text += fmt::format("samples from t {} to t {} at most\n", number(trace, trace.begin), number(trace, trace.end));
    return text + line_of(trace, "sample", "t", "DE", "tolerance", "decided");
}

template <class Real>
void trace_in(const Scene& scene, const RendererOptions& options, Trace& trace)
{
    TracePixel<Real>* const traced =
        pixel_tracer<Real>(variant_name(scene.fractal->name, options.precision, options.mode));
    if (traced == nullptr) throw Unavailable(fmt::format("no rays are traced for the {}", scene.fractal->name));
    traced(kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques), trace);
}

}  // namespace

Trace trace_pixel(const Scene& scene, const RendererOptions& options, int x, int y)
{
    Trace trace{};
    trace.precision = options.precision;
    trace.mode = options.mode;
    trace.x = x;
    trace.y = y;
    trace.width = scene.width;
    trace.height = scene.height;
    options.precision == Precision::f32 ? trace_in<float>(scene, options, trace)
                                        : trace_in<double>(scene, options, trace);
    return trace;
}

std::string text_of(const Trace& trace)
{
    std::string text = head(trace);
    const TracedSample* from = nullptr;  // the last sample that was not taken back
    for (std::size_t i = 0; i < trace.marching.size(); ++i) {
        const TracedSample& sample = trace.marching[i];
        if (from == nullptr || sample.decision != Decision::taken_back) from = &sample;
        text += line_of(trace, i, sample, decided(trace, sample, *from));
    }
    for (std::size_t i = 0; i < trace.refining.size(); ++i) {
        const TracedSample& sample = trace.refining[i];
        text += line_of(trace, i, sample, "refining, " + decided(trace, sample, sample));
    }
    if (trace.refined != Refined::never) text += fmt::format("refining {}\n", words(trace.refined));
    text += trace.hit ? fmt::format("hit: t {}\n", number(trace, trace.pixel.depth)) : "no hit\n";
    if (trace.normal) text += fmt::format("normal {}\n", three(trace, *trace.normal));
    text += fmt::format("colour {}, as bytes {} {} {}\n",
                        three(trace, {trace.pixel.red, trace.pixel.green, trace.pixel.blue}), trace.bytes[0],
                        trace.bytes[1], trace.bytes[2]);
    return text + fmt::format("steps {}, estimates {}, iterations {}\n", trace.pixel.steps, trace.de_calls,
                              trace.pixel.iterations);
}

}  // namespace mandelmarch
