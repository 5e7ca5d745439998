// SPDX-License-Identifier: Apache-2.0
// The options of mandelbulb, mandelbox and render.
#include "apps/renderer_app.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <vector>

#include "apps/cli/options.h"
#include "core/image/image.h"
#include "core/render/trial.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/version.h"

namespace mandelmarch {
namespace {

constexpr int most_samples = 8;  // per pixel side

// Throws InputError if an option was given that has no effect in what the program does.
void refuse_unused(const CLI::App& app, const RenderOptions& options)
{
    // The hull is the only technique of exact mode.
    const std::string without = disabled(options.renderer.techniques);
    if (options.renderer.mode == Mode::exact && !without.empty() && without != "hull") {
        throw InputError(fmt::format("--without: '{}' given, expected hull, or --mode fast", options.without));
    }
    if (options.list_devices) refuse_others(app, "--list-devices", {"--list-devices"});
    if (options.list_fractals) refuse_others(app, "--list-fractals", {"--list-fractals", "--json"});
    std::vector<std::string> taken{"PARAMS",     "--fractal",   "--size", "--projection", "--look",
                                   "--estimate", "--precision", "--mode", "--without"};
    if (options.print_scene) {
        taken.emplace_back("--print-scene");
        refuse_others(app, "--print-scene", taken);
    }
    if (!options.trace) return;
    taken.insert(taken.end(), {"--trace", "--pixel"});
    // Only a trial uses a backend.
    if (is_tried(options.renderer)) taken.insert(taken.end(), {"--backend", "--device", "--threads", "--simd-width"});
    refuse_others(app, "--trace", taken);
}

}  // namespace

RenderOptions parse_options(const char* program, const char* fractal, const Registry& registry, int argc, char** argv,
                            std::optional<int>& done)
{
    CLI::App app(fmt::format("{}: renders a {} from a parameter file by ray marching.", program,
                             fractal != nullptr ? fractal : "fractal"));
    app.set_version_flag("--version", version_line(program));
    RenderOptions options;
    app.add_option("PARAMS", options.parameters,
                   fmt::format("parameter file (.dat); -: standard input{}",
                               fractal == nullptr ? "; without it, renders the fractal's official scene" : ""));
    if (fractal == nullptr) add_fractal_option(app, options.fractal);
    add_backend_option(app, options.backend, registry);
    app.add_option("--device", options.renderer.device, "device of that backend, from 0 (see --list-devices)")
        ->check(whole(0, 1'000'000))
        ->capture_default_str();
    add_precision_options(app, options.renderer);
    add_estimate_option(app, options.conservative);
    add_projection_option(app, options.projection);
    add_look_option(app, options.look, options.look_file, "colouring type of PARAMS");
    app.add_option("--eyes", options.eyes, "render side-by-side stereo with this eye distance, in scene units")
        ->check(real(0, 1e6));
    app.add_option("--size", options.size, "WxH in pixels, 720p, 1080p, 4k or 8k (default: from PARAMS)");
    app.add_option("--region", options.region,
                   "render only this part: X,Y,WIDTH,HEIGHT in pixels from the bottom left; parts that are joined "
                   "need --mode exact, else their edges can show");
    app.add_option("--samples", options.samples,
                   "samples per pixel side, 1 to 8; 2 means 4 per pixel (default 1, or 2 if PARAMS sets "
                   "super-sampling)")
        ->check(whole(1, most_samples));
    add_threads_option(app, options.renderer.threads);
    app.add_option("--simd-width", options.renderer.simd_width,
                   "pixels computed at once per core; 1: scalar, 0 (default): automatic")
        ->check(whole(0, 1024));
    app.add_option("--without", options.without,
                   "disable optimisations, for ablation: "
                   "hull,relaxation,cones,neighbours,trial,refinement,tail,gradient,shared-occlusion");
    app.add_option("--output", options.output,
                   "picture: .bmp, .png, .ppm, .jpg or .exr (default: from PARAMS; -: standard output, as BMP)");
    app.add_option("--stats", options.stats, "write times and work counts to this file, as JSON");
    auto* pixel = app.add_option("--pixel", options.pixel, "X,Y of the pixel to trace, from the bottom left");
    auto* trace = app.add_flag("--trace", options.trace, "print the steps of that pixel's ray instead of rendering");
    trace->needs(pixel);
    pixel->needs(trace);
    app.add_flag("--list-devices", options.list_devices, "list backends and devices instead of rendering");
    auto* list = app.add_flag("--list-fractals", options.list_fractals,
                              "list fractals and their parameters instead of rendering");
    app.add_flag("--json", options.json,
                 "print --list-fractals as JSON, with the formulas of each fractal's kernel constants")
        ->needs(list);
    app.add_flag(
        "--print-scene", options.print_scene,
        "print the scene as the kernels receive it, as JSON, and render nothing; the step factor is the initial one, "
        "which a trial render may reduce");
    app.footer(fmt::format(
        "Memory: about {} MiB plus, for each pixel, {} bytes ({} for an EXR file, {} for an EXR file into a pipe). "
        "16384 x 16384 pixels need {} MiB as BMP or PNG. With --samples N, a pixel needs N x N times as much.\n"
        "With --region, --size may have sides of up to 1000000 pixels. In exact mode a region has the same bits as "
        "that part of the whole picture.\n"
        "Channels of an EXR file: R, G, B (linear light, Rec. 709), displayed.R, displayed.G, displayed.B (as shown on "
        "a screen), Z (length of the ray), steps and iterations.\n"
        "The field of view in a parameter file is vertical; 1 means 65 degrees.\n"
        "An existing file is replaced only after the new one is complete.\n"
        "Exit codes: 0 success, 1 failure, 2 wrong arguments or bad input, 77 backend or device not available.{}",
        fixed_memory >> 20, Image::bytes_per_pixel(Image::Layers::bytes), Image::bytes_per_pixel(Image::Layers::all),
        Image::bytes_per_pixel(Image::Layers::all) + exr_stream_memory,
        ((Image::bytes_per_pixel(Image::Layers::bytes) << 28) + fixed_memory) >> 20, environment_help(program)));
    done = parse_arguments(app, program, argc, argv);
    if (done) return options;
    options.renderer.techniques = techniques_without(options.without);
    refuse_unused(app, options);
    options.parameters = input_name(options.parameters);
    options.output = output_name(options.output);
    options.stats = output_name(options.stats);
    options.renderer.counts = !options.stats.empty();
    if (fractal != nullptr) options.fractal = fractal;
    if (options.fractal.empty() && !options.lists()) {
        throw InputError(fmt::format("{}: no fractal given, expected --fractal NAME (--help lists them)", program));
    }
    if (options.parameters.empty() && fractal != nullptr && !options.lists()) {
        throw InputError(fmt::format("{}: no parameter file given, expected {} PARAMS.dat", program, program));
    }
    return options;
}

}  // namespace mandelmarch
