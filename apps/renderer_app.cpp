// SPDX-License-Identifier: Apache-2.0
#include "apps/renderer_app.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "apps/cli/options.h"
#include "apps/scene_json.h"
#include "apps/survey.h"
#include "core/image/averaged.h"
#include "core/image/formats/image_file.h"
#include "core/image/image.h"
#include "core/instruments/trace.h"
#include "core/os/files.h"
#include "core/os/memory.h"
#include "core/os/output_file.h"
#include "core/os/progress_bar.h"
#include "core/render/region.h"
#include "core/render/stereo.h"
#include "core/render/trial.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

constexpr double beside = 110;            // degrees; azimuth of a sun to the right, a little behind the camera
constexpr int largest_whole = 1'000'000;  // pixels; largest side of a picture if only a region of it is rendered

// Returns the parameters of the file or, if no file is given, of the fractal's official scene.
ParameterFile parameters_of(const RenderOptions& options)
{
    const Fractal& fractal = fractal_named(options.fractal);
    if (!options.parameters.empty()) return read_parameters(options.parameters, fractal);
    return parse_parameters(fractal.official, fmt::format("the official scene of {}", fractal.name), fractal);
}

// Applies --size to the scene.
void apply_size(const RenderOptions& options, Scene& scene)
{
    if (options.size.empty()) return;
    std::tie(scene.width, scene.height) = size_option(options.size, options.region.empty() ? max_side : largest_whole,
                                                      panoramas(options.projection, options.eyes > 0));
}

// Gives the scene a look, under a sky as in films: the horizon is level for a level camera, and the sun is beside it.
void apply_look(const ChosenLook& chosen, Scene& scene)
{
    scene.colouring = chosen.colouring;
    scene.look = chosen.values;
    const LookValues* look = look_of(scene);
    if (look == nullptr) return;
    scene.sky = turned(scene.sky, unit(scene.fractal->flight.upward(scene.eye, scene.up)));
    scene.sky.sun = sun_at(scene.sky, scene.target - scene.eye, look->sun_height(),
                           look->sun_azimuth() > 0 ? look->sun_azimuth() : beside);
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

Drawing drawing_of(const RenderOptions& options, const Scene& scene)
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
const Backend& drawing_backend(const Registry& registry, const RenderOptions& options)
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
void print_trace(const char* program, const RenderOptions& options, const Registry& registry, Scene scene)
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

}  // namespace

int render_program(const Registry& registry, const char* program, const char* fractal, int argc, char** argv)
{
    std::optional<int> done;
    RenderOptions options = parse_options(program, fractal, registry, argc, argv, done);
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
    if (options.look) apply_look(*options.look, scene);
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
                        {{"the parameter file", options.parameters}, {"--look", options.look_file}});
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

}  // namespace mandelmarch
