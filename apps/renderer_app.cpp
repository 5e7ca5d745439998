// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include "cli/backend_option.h"
#include "cli/option_values.h"
#include "cli/progress_bar.h"
#include "apps/scene_json.h"
#include "apps/scene_options.h"
#include "apps/stats.h"
#include "apps/survey.h"
#include "backends/all.h"
#include "core/base/console.h"
#include "core/base/environment.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/memory.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/image/averaged.h"
#include "core/image/formats/image_file.h"
#include "core/render/region.h"
#include "core/render/stereo.h"
#include "core/render/trial.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/image/image.h"
#include "instruments/trace.h"

namespace mandelmarch {
namespace {

// Memory that the program needs in addition to the picture: code, libraries, the threads' stacks, one row of a file.
constexpr std::uint64_t fixed_memory = 128ULL << 20;  // bytes
// An EXR file that is written to a pipe is built in memory, in two copies of nine channels of four bytes.
constexpr std::uint64_t exr_stream_memory = 72;  // bytes per pixel
constexpr int most_samples = 8;                  // per pixel side
constexpr int largest_whole = 1'000'000;         // pixels; largest side of a picture if only a region of it is rendered

struct Options {
    std::string parameters;
    std::string fractal;
    std::string backend = "auto";
    RendererOptions renderer;
    std::string size;
    std::string region;
    std::string output;
    std::string stats;
    std::string pixel;
    std::string without;
    bool conservative = false;
    Projection projection = Projection::perspective;
    double eyes = 0;
    int samples = 0;  // per pixel side; 0: not given, the parameter file decides
    bool trace = false;
    bool list_devices = false;
    bool list_fractals = false;
    bool json = false;
    bool print_scene = false;

    // Returns true if the program only lists devices or fractals.
    bool lists() const { return list_devices || list_fractals; }
};

// Throws InputError if an option was given that has no effect in what the program does.
void refuse_unused(const CLI::App& app, const Options& options)
{
    // The hull is the only technique of exact mode.
    const std::string without = disabled(options.renderer.techniques);
    if (options.renderer.mode == Mode::exact && !without.empty() && without != "hull") {
        throw InputError(fmt::format("--without: '{}' given, expected hull, or --mode fast", options.without));
    }
    if (options.list_devices) refuse_others(app, "--list-devices", {"--list-devices"});
    if (options.list_fractals) refuse_others(app, "--list-fractals", {"--list-fractals", "--json"});
    std::vector<std::string> taken{"PARAMS",     "--fractal",   "--size", "--projection",
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

Options parse_options(const char* program, const char* fractal, const Registry& registry, int argc, char** argv,
                      std::optional<int>& done)
{
    CLI::App app(fmt::format("{}: renders a {} from a parameter file by ray marching.", program,
                             fractal != nullptr ? fractal : "fractal"));
    app.set_version_flag("--version", version_line(program));
    Options options;
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
    app.add_option("--eyes", options.eyes, "render side-by-side stereo with this eye distance, in scene units")
        ->check(real(0, 1e6));
    app.add_option("--size", options.size, "WxH in pixels, 720p, 1080p, 4k or 8k (default: from PARAMS)");
    app.add_option("--region", options.region,
                   "render only this part: X,Y,WIDTH,HEIGHT in pixels from the bottom left");
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

// Returns the parameters of the file or, if no file is given, of the fractal's official scene.
ParameterFile parameters_of(const Options& options)
{
    const Fractal& fractal = fractal_named(options.fractal);
    if (!options.parameters.empty()) return read_parameters(options.parameters, fractal);
    return parse_parameters(fractal.official, fmt::format("the official scene of {}", fractal.name), fractal);
}

// Applies --size to the scene.
void apply_size(const Options& options, Scene& scene)
{
    if (options.size.empty()) return;
    std::tie(scene.width, scene.height) = size_option(options.size, options.region.empty() ? max_side : largest_whole,
                                                      panoramas(options.projection, options.eyes > 0));
}

// Returns the format for a file name. `commented`: the name comes from a parameter file, from a line that ends with a
// comment.
ImageFormat format_of(const std::string& path, bool commented)
{
    if (const auto format = image_format(path)) return *format;
    if (OutputFile::is_stream(path)) return ImageFormat::bmp;
    throw InputError(
        fmt::format("{}: the file name's ending names no format, expected {}{}", path, image_endings,
                    commented ? " (the name ends before a # behind a blank, which begins a comment)" : ""));
}

// The scene and the region to render. Their sizes are counted in samples, not in pixels.
struct Drawing {
    Scene scene;
    Region region;
};

Drawing drawing_of(const Options& options, const Scene& scene)
{
    Drawing drawing{scene, {0, 0, scene.width, scene.height}};
    if (!options.region.empty()) drawing.region = region_option(options.region, scene.width, scene.height);
    if (!options.region.empty() && options.eyes > 0)
        throw InputError("--region: cannot be combined with --eyes, which renders whole pictures");
    Region& region = drawing.region;
    const int n = options.samples;
    const int most = (options.region.empty() ? max_side : largest_whole) / n;
    if (std::max(scene.width, scene.height) > most || std::max(region.width, region.height) > max_side / n) {
        throw InputError(
            fmt::format("--size: {} x {} pixels of {} x {} samples, expected sides of up to {}, and of {} "
                        "in a region",
                        scene.width, scene.height, n, n, most, max_side / n));
    }
    drawing.scene.width *= n;
    drawing.scene.height *= n;
    region = {n * region.left, n * region.bottom, n * region.width, n * region.height};
    return drawing;
}

// Throws InputError if the picture needs more than the available memory. `stream`: the output is a pipe or device.
void check_memory(const Drawing& drawing, ImageFormat format, bool stream)
{
    const std::uint64_t pixels = pixels_in_memory(drawing.scene, drawing.region);
    const std::uint64_t per_pixel =
        Image::bytes_per_pixel(layers_of(format)) + (stream && format == ImageFormat::exr ? exr_stream_memory : 0);
    const std::uint64_t needed = pixels * per_pixel + fixed_memory;
    const std::string size = fmt::format("{} x {} pixels", drawing.region.width, drawing.region.height);
    const std::string lack = memory_shortage(size, needed);
    if (!lack.empty()) throw InputError(lack + ", expected a smaller size, or regions (--region)");
}

std::pair<Image, RenderStats> draw(Renderer& renderer, const Drawing& drawing, double eyes, Image::Layers layers,
                                   const Progress& progress)
{
    if (eyes == 0) return render_region(renderer, drawing.scene, drawing.region, layers, progress);
    Image image(drawing.scene.width, drawing.scene.height, layers);
    RenderStats report = render_stereo(renderer, drawing.scene, eyes, image, progress);
    return {std::move(image), std::move(report)};
}

// Lists every backend and its devices; returns false if a driver failed.
bool list_devices(const Registry& registry)
{
    bool ok = true;
    for (const auto& backend : registry.backends()) {
        const Listing listing = listing_of(*backend);
        int index = 0;
        for (const Device& device : listing.devices) {
            print("{:<10} {}: {} ({}, {})\n", backend->name(), index++, device.name, device.vendor, device.driver);
        }
        if (!listing.unavailable.empty()) print("{:<10} unavailable: {}\n", backend->name(), listing.unavailable);
        if (!listing.failure.empty()) print("{:<10} FAILED: {}\n", backend->name(), listing.failure);
        ok = ok && listing.failure.empty();
    }
    return ok;
}

// Warns that the picture would change with shorter steps. `off`: the fraction of a trial's pixels that do change.
void warn_unsettled(const char* program, double off, Precision precision)
{
    say("{}: shorter steps would change {:.0f} % of the picture: {}the distance estimate is too large\n", program,
        100 * off, precision == Precision::f32 ? "float's digits are too few (--precision double has more) or " : "");
}

// Returns the chosen backend. Throws InputError if it does not support an option that was given.
const Backend& drawing_backend(const Registry& registry, const Options& options)
{
    const Backend& backend = chosen_backend(registry, options.backend, true, options.renderer);
    refuse_unheeded(registry, backend, options.renderer);
    if (!options.without.empty() && backend.info().role == Role::reference) {
        throw InputError(fmt::format("--without: not supported by backend {}, expected another one", backend.name()));
    }
    return backend;
}

// Prints the trace of a pixel's ray. In fast mode, a trial render on the backend first chooses the step factor
// (core/render/trial.h).
void print_trace(const char* program, const Options& options, const Registry& registry, Scene scene)
{
    const std::string expected = fmt::format("X,Y of a pixel, from 0,0 at the bottom left to {},{} at the top right",
                                             scene.width - 1, scene.height - 1);
    const auto [x, y] = pair_option("pixel", options.pixel, ',', 0, max_side, expected);
    if (x >= scene.width || y >= scene.height) {
        throw InputError(fmt::format("--pixel: '{}' given, expected {}", options.pixel, expected));
    }
    if (is_tried(options.renderer)) {
        const Backend& backend = drawing_backend(registry, options);
        const Trial trial = try_steps(scene, backend, options.renderer);
        scene.limits.step_factor = trial.step_factor;
        print("a trial on {} chose the step factor\n", backend.name());
        if (!trial.settled()) warn_unsettled(program, trial.off, options.renderer.precision);
    }
    print(text_of(trace_pixel(scene, options.renderer, x, y)));
}

int render_program(const Registry& registry, const char* program, const char* fractal, int argc, char** argv)
{
    std::optional<int> done;
    Options options = parse_options(program, fractal, registry, argc, argv, done);
    if (done) return *done;
    if (options.list_devices) {
        return list_devices(registry) ? exit_success : exit_failure;
    }
    if (options.list_fractals) {
        print(std::string_view(options.json ? fractals_json() : fractals_text()));
        return exit_success;
    }
    ParameterFile parameters = parameters_of(options);
    for (const std::string& warning : parameters.warnings) say("{}\n", printable(warning));
    Scene& scene = parameters.scene;
    apply_size(options, scene);
    scene.conservative = options.conservative;
    if (options.samples == 0) options.samples = parameters.super_sampling ? 2 : 1;
    scene.projection = options.projection;
    check_panorama(scene.projection, scene.width, scene.height, options.eyes > 0 ? 2 : 1);
    if (options.print_scene) {
        print(std::string_view(scene_json(scene, options.renderer)));
        return exit_success;
    }
    if (options.trace) {
        print_trace(program, options, registry, scene);
        return exit_success;
    }

    const std::string output = options.output.empty() ? output_name(scene.image_file) : options.output;
    const ImageFormat format = format_of(output, options.output.empty() && parameters.comment_behind_name);
    const Drawing drawing = drawing_of(options, scene);
    check_image_size(format, drawing.region.width / options.samples, drawing.region.height / options.samples);
    refuse_shared_files({{"the picture", output}, {"--stats", options.stats}},
                        {{"the parameter file", options.parameters}});
    OutputFile::check(output);
    if (!options.stats.empty()) OutputFile::check(options.stats);
    check_memory(drawing, format, OutputFile::is_stream(output));

    const Backend& backend = drawing_backend(registry, options);
    const auto renderer = backend.create(options.renderer);
    ProgressBar bar(program);
    const auto [image, report] =
        draw(*renderer, drawing, options.eyes, layers_of(format), [&bar](double share) { bar.show(share); });
    bar.finish();
    const Survey survey = survey_of(scene, options.eyes, options.renderer, *renderer, registry.with(Role::host));
    const bool one_colour = has_one_colour(image);
    refuse_solid(survey, one_colour, options.parameters);
    const std::vector<std::string> words = words_of(survey, scene, one_colour);
    for (const std::string& word : words) say("{}: {}\n", program, word);
    if (report.unsettled > 0 && words.empty()) warn_unsettled(program, report.unsettled, options.renderer.precision);
    const auto write_picture = [&, image = &image] {
        write_image(output, format, options.samples > 1 ? averaged(*image, options.samples) : *image);
    };
    try {
        // The statistics come first, so that after a kill no picture is there without them.
        if (!options.stats.empty()) write_stats(options.stats, scene, report, survey, words);
    } catch (const Error&) {
        write_picture();
        throw;
    }
    write_picture();
    return exit_success;
}

}  // namespace

int renderer_main(const char* program, const char* fractal, int argc, char** argv)
{
    const auto body = [&](int count, char** values) {
        return render_program(program_backends(count, values), program, fractal, count, values);
    };
    return run_program(program, body, argc, argv);
}

}  // namespace mandelmarch
