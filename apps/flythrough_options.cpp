// SPDX-License-Identifier: Apache-2.0
#include "apps/flythrough_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <tuple>
#include <variant>

#include "cli/backend_option.h"
#include "cli/option_values.h"
#include "apps/scene_options.h"
#include "core/base/environment.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/number.h"
#include "core/base/version.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

constexpr int most_frames = 10'000'000;

const std::vector<std::pair<std::string, Command>> commands{{"plan", Command::plan},
                                                            {"render", Command::render},
                                                            {"preview", Command::preview},
                                                            {"film", Command::film},
                                                            {"audit", Command::audit}};

const std::string& name_of(Command command)
{
    return std::ranges::find(commands, command, &std::pair<std::string, Command>::second)->first;
}

// Values of options whose meaning depends on the command.
struct Given {
    std::optional<std::variant<int, Range>> frames;  // a number of frames, or a range of a path's frames
    std::optional<int> rate;
    std::optional<std::string> size;
    std::optional<std::size_t> every;
};

// Defaults of preview.
constexpr std::size_t preview_every = 8;
constexpr std::pair preview_size{480, 270};

Range range_option(const std::string& name, const std::string& text, const std::string& expected)
{
    const auto [a, b] = pair_option(name, text, '-', 0, most_frames, expected);
    if (a > b) throw InputError(fmt::format("--{}: {}-{} given, expected the first one first", name, a, b));
    return {static_cast<std::size_t>(a), static_cast<std::size_t>(b)};
}

std::variant<int, Range> frames_option(const std::string& text)
{
    const auto count = parse_whole(text);
    if (count && *count >= 2 && *count <= most_frames) return static_cast<int>(*count);
    return range_option(
        "frames", text,
        fmt::format("A-B, frames of the path to render, such as 100-160, or a whole number from 2 to {} "
                    "to plan",
                    most_frames));
}

// Sets the look to a colouring type, given by its number or name, or to a look file.
void set_look(const std::string& text, Flythrough& options)
{
    if (parse_whole(text)) {
        options.look = {.colouring = whole_option("look", text, 0, colouring_types - 1)};
        return;
    }
    for (int type = 2; type < colouring_types; ++type) {
        if (text != colouring_names.at(static_cast<std::size_t>(type))) continue;
        options.look = {.colouring = type};
        return;
    }
    options.look_file = text;
    options.look = {.colouring = 2, .values = parse_look(text_of_file(text, "look file"), text)};
}

void add_options(CLI::App& app, const Registry& registry, Flythrough& options, Given& given)
{
    add_choice(app, "COMMAND", options.command, commands, "what to do (explained below)")->default_str("")->required();
    app.add_option("PATH", options.path,
                   "path file: read by render, preview and audit, written by plan and, if given, by film");
    add_fractal_option(app, options.fractal)->capture_default_str();
    app.add_option("--params", options.parameters,
                   "plan, film: take the fractal, not the camera, from this parameter file (.dat)");
    app.add_option("--seed", options.seed, "plan, film: random seed of the route")
        ->check(whole(0, std::int64_t{1} << 53))
        ->capture_default_str();
    const std::string changing =
        " (A), or a change of it: A:B (from the first frame to the last) or 0s=A,60s=B (at these seconds)";
    app.add_option("--power", options.power, "plan, film: the Mandelbulb's power" + changing);
    app.add_option("--scale", options.scale, "plan, film: the Mandelbox's scale" + changing);
    app.add_option("--places", options.places, "plan, film: table of places to visit (docs/make-a-film.md)");
    add_estimate_option(app, options.conservative);
    app.add_option_function<std::string>(
        "--frames", [&](const std::string& text) { given.frames = frames_option(text); },
        "plan, film: number of frames, without the title (default: 4 minutes); render, preview: only frames A-B (from "
        "0)");
    app.add_option("--from", options.part.from, "film, render, preview: only the flight from this second on")
        ->check(real(0, most_frames));
    app.add_option("--to", options.part.to, "film, render, preview: only the flight up to this second")
        ->check(real(0, most_frames));
    add_choice(app, "--chapter", options.part.chapter,
               {{"approach", Chapter::approach}, {"passages", Chapter::passages}, {"out", Chapter::out}},
               "film, render, preview: only the flight before, from, or after its narrow places; --from and --to then "
               "count from the chapter's beginning");
    app.add_option("--fps", given.rate, "plan, film: frames per second, recorded in the path file (default 30)")
        ->check(whole(1, most_frames_per_second));
    app.add_option("--size", given.size,
                   "WxH in pixels, even; 720p, 1080p, 4k or 8k (default 1920x1080; equirectangular: 2160x1080; "
                   "preview: 480x270)");
    add_projection_option(app, options.projection);
    app.add_flag("--stereo", options.stereo, "film, render, preview: side-by-side stereo, the left eye on the left");
    app.add_option("--samples", options.samples, "samples per pixel side, 1 to 8; 2 means 4 per pixel")
        ->check(real(1, 8))
        ->capture_default_str();
    add_backend_option(app, options.backend, registry);
    app.add_option("--device", options.device,
                   "device of that backend, from 0 (default: each MPI rank uses its own GPU)")
        ->check(whole(0, 1'000'000));
    add_precision_options(app, options.renderer);
    add_threads_option(app, options.threads);
    app.add_option_function<std::string>(
        "--look", [&](const std::string& text) { set_look(text, options); },
        "look: number, name or file (default: plan, film: coral; otherwise the path file's)");
    app.add_option(
        "--output", options.output,
        "plan: path file (default PATH or path.json); film, render, preview: .mp4, .mkv, .webm or .gif (default "
        "video.mp4; preview: preview.mp4)");
    app.add_option("--json", options.json, "plan, film, audit: write the audit to this file, as JSON");
    app.add_option("--map", options.map,
                   "plan, film: write the data for a drawing of the flight to this file, as JSON: free spheres and "
                   "narrow passages near the path, and for every frame the camera's position, turn and distance to the "
                   "surface");
    app.add_option("--summary", options.summary,
                   "film, render, preview: write device, frames and seconds per frame to this file, as JSON");
    app.add_option("--title", options.title,
                   "first line of the title; without --title and --authors there is no title");
    app.add_option("--authors", options.authors, "second line of the title");
    app.add_option("--stills", options.stills, "write still frames to this folder instead of a film");
    add_choice(app, "--still-format", options.jpeg, {{"png", false}, {"jpeg", true}}, "format of stills");
    app.add_option("--every", given.every,
                   "film, render, preview: only every N-th frame, so a film is N times as fast (default 1; preview: 8)")
        ->check(whole(1, most_frames));
    app.add_option_function<std::string>(
        "--segments",
        [&](const std::string& text) { options.segments = range_option("segments", text, "A-B, such as 0-9"); },
        "render only segments A-B (60 frames each, from 0), and do not join them into a film");
    app.add_flag("--force", options.force,
                 "render even if the path breaks a promise: a hard limit, marked ! in the audit's output");
    app.footer(
        "Commands: plan writes a path file and prints its audit; audit prints the audit of a path file; render makes a "
        "film from a path file; preview makes one that is small and fast; film plans, prints the audit and renders.\n"
        "To continue an interrupted film, run the same command again. mpirun distributes the work among its ranks.\n"
        "Exit codes: 0 success, 1 failure or a broken promise, 2 wrong arguments or bad input, 77 backend not "
        "available." +
        environment_help("flythrough"));
}

// Sets the pictures' size to that of --size or to the default, which depends on the other options.
void set_size(const Given& given, Flythrough& options)
{
    const int pictures = options.stereo ? 2 : 1;
    const bool panorama = options.projection == Projection::equirectangular;
    std::tie(options.width, options.height) =
        given.size ? size_option(*given.size, max_side, panoramas(options.projection, options.stereo))
        : panorama ? std::pair{pictures * 2160, 1080}
        : options.command == Command::preview ? preview_size
                                              : std::pair{1920, 1080};
    check_panorama(options.projection, options.width, options.height, pictures);
    if (options.stereo && options.width % 4 != 0) {
        throw InputError(fmt::format("--stereo: a width of {} given, expected a multiple of 4", options.width));
    }
}

// Sets the number of frames to plan, or the range of the path's frames to render.
void set_frames(const Given& given, Flythrough& options)
{
    if (!options.reads_path()) {
        constexpr int usual_seconds = 240;
        options.rate = given.rate.value_or(options.rate);
        options.frames = usual_seconds * options.rate;
        if (!given.frames) return;
        const auto* const count = std::get_if<int>(&*given.frames);
        if (count == nullptr) throw InputError("--frames: a range given, expected a whole number of frames to plan");
        options.frames = *count;
        return;
    }
    if (given.rate) {
        throw InputError(fmt::format("--fps: {} takes the rate from the path file, expected plan or film",
                                     name_of(options.command)));
    }
    if (!given.frames) return;
    if (!options.part.whole()) throw InputError("--frames: cannot be combined with --from, --to or --chapter");
    if (options.command == Command::audit) throw InputError("--frames: not supported by audit, which uses all frames");
    const auto* const range = std::get_if<Range>(&*given.frames);
    if (range == nullptr) {
        throw InputError("--frames: a number given, expected A-B, frames of the path, such as 100-160");
    }
    options.chosen = *range;
}

// Throws InputError if --from and --to choose no frame of the flight, as far as that is known before planning.
void check_seconds(const Flythrough& options)
{
    const Part& part = options.part;
    if (part.from && part.to && *part.from >= *part.to) {
        throw InputError(fmt::format("--from, --to: {} and {} given, expected a later end", *part.from, *part.to));
    }
    const double length = static_cast<double>(options.frames) / options.rate;
    if (!options.reads_path() && std::max(part.from.value_or(0), part.to.value_or(0)) > length) {
        throw InputError(fmt::format("--from, --to: the film has {:.4g} s, expected seconds within it", length));
    }
}

}  // namespace

std::vector<NamedFile> Flythrough::written() const
{
    std::vector<NamedFile> files;
    if (command == Command::film) files.push_back({"PATH", path});
    if (command == Command::plan || (command != Command::audit && stills.empty()))
        files.push_back({"--output", output});
    if (!reads_path() || command == Command::audit) files.push_back({"--json", json});
    if (!reads_path()) files.push_back({"--map", map});
    if (command != Command::plan && command != Command::audit) files.push_back({"--summary", summary});
    return files;
}

std::vector<NamedFile> Flythrough::read() const
{
    if (reads_path()) return {{"PATH", path}, {"--look", look_file}};
    return {{"--params", parameters}, {"--places", places}, {"--look", look_file}};
}

Flythrough parse_flythrough(const Registry& registry, int argc, char** argv, std::optional<int>& done)
{
    CLI::App app("flythrough: plans a flight through a fractal, audits it and renders it as a film.");
    Flythrough options;
    Given given;
    app.set_version_flag("--version", version_line("flythrough"));
    add_options(app, registry, options, given);
    done = parse_arguments(app, "flythrough", argc, argv);
    if (done) return options;
    fractal_named(options.fractal);
    set_frames(given, options);
    set_size(given, options);
    options.every = given.every.value_or(options.command == Command::preview ? preview_every : 1);
    if (options.device) options.renderer.device = *options.device;
    const bool reads = options.reads_path();
    if (reads && options.path.empty()) {
        throw InputError(
            fmt::format("flythrough: no path file given, expected flythrough {} PATH", name_of(options.command)));
    }
    if (reads && !(options.power.empty() && options.scale.empty())) {
        throw InputError(fmt::format("--{}: {} takes the shape from the path file, expected plan or film",
                                     options.power.empty() ? "scale" : "power", name_of(options.command)));
    }
    if (reads && !options.places.empty()) {
        throw InputError(fmt::format("--places: {} renders the path file's flight, expected plan or film",
                                     name_of(options.command)));
    }
    if (!options.part.whole() && (options.command == Command::plan || options.command == Command::audit)) {
        throw InputError(
            fmt::format("--from, --to, --chapter: {} uses the whole flight, expected film, render or preview",
                        name_of(options.command)));
    }
    check_seconds(options);
    if (!options.stills.empty() && !options.summary.empty()) {
        throw InputError("--summary: cannot be combined with --stills (it describes a film)");
    }
    options.path = reads ? input_name(options.path) : output_name(options.path);
    options.parameters = input_name(options.parameters);
    for (std::string* file : {&options.output, &options.json, &options.map, &options.summary})
        *file = output_name(*file);
    if (options.output.empty()) {
        const std::string planned = options.path.empty() ? "path.json" : options.path;
        options.output = options.command == Command::plan      ? planned
                         : options.command == Command::preview ? "preview.mp4"
                                                               : "video.mp4";
    }
    return options;
}

}  // namespace mandelmarch
