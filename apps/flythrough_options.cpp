// SPDX-License-Identifier: Apache-2.0
#include "apps/flythrough_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <tuple>

#include "apps/cli/options.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/version.h"

namespace mandelmarch {
namespace {

constexpr int most_frames = 10'000'000;

struct CommandName {
    const char* name;
    Command command;
    const char* about;
};
constexpr CommandName commands[] = {
    {"plan", Command::plan, "write a path file and print its audit"},
    {"render", Command::render, "make a film or stills of a path file"},
    {"preview", Command::preview, "make a small film of every 8th frame of a path file"},
    {"film", Command::film, "plan, print the audit, and make a film or stills"},
    {"audit", Command::audit, "print the audit of a path file; exit code 1: a broken promise"}};

CLI::Option* add_range(CLI::App& app, const std::string& name, std::optional<Range>& range, const std::string& expected,
                       const std::string& about)
{
    const auto set = [&range, name, expected](const std::string& text) {
        const auto [a, b] = pair_option(name, text, '-', 0, most_frames, expected);
        if (a > b) throw InputError(fmt::format("--{}: {}-{} given, expected the first one first", name, a, b));
        range = {static_cast<std::size_t>(a), static_cast<std::size_t>(b)};
    };
    return app.add_option_function<std::string>("--" + name, set, about);
}

// Adds the options of commands that plan a flight.
void add_planning(CLI::App& app, Flythrough& options)
{
    add_fractal_option(app, options.fractal)->capture_default_str();
    app.add_option("--params", options.parameters, "take the fractal, not the camera, from this parameter file (.dat)");
    app.add_option("--seed", options.plan.seed, "random seed of the route")
        ->check(whole(0, std::int64_t{1} << 53))
        ->capture_default_str();
    const std::string changing =
        " (A), or a change of it: A:B (from the first frame to the last) or 0s=A,60s=B (at these seconds)";
    auto* power = app.add_option("--power", options.power, "the Mandelbulb's power" + changing);
    app.add_option("--scale", options.scale, "the Mandelbox's scale" + changing)->excludes(power);
    app.add_option("--places", options.places, "table of places to visit (docs/make-a-film.md)");
    add_estimate_option(app, options.conservative);
    app.add_option("--frames", options.frames, "number of frames, without the title (default: 4 minutes)")
        ->check(whole(2, most_frames));
    options.rate = frames_per_second;
    app.add_option("--map", options.map,
                   "write the data for a drawing of the flight to this file, as JSON: free spheres and narrow passages "
                   "near the path, and for every frame the camera's position, turn and distance to the surface");
}

// Adds the options of commands that make a film or stills.
void add_filming(CLI::App& app, Flythrough& options)
{
    FilmOptions& film = options.film;
    std::vector<CLI::Option*> parts{
        app.add_option("--from", options.part.from, "only the flight from this second on")->check(real(0, most_frames)),
        app.add_option("--to", options.part.to, "only the flight up to this second")->check(real(0, most_frames)),
        add_choice(app, "--chapter", options.part.chapter,
                   {{"approach", Chapter::approach}, {"passages", Chapter::passages}, {"out", Chapter::out}},
                   "only the flight before, from, or after its narrow places; --from and --to then count from the "
                   "chapter's beginning")};
    if (options.reads_path()) {
        auto* frames = add_range(app, "frames", film.frames, "A-B, frames of the path to render, such as 100-160",
                                 "only frames A-B of the path (from 0)");
        for (CLI::Option* part : parts) part->excludes(frames);
        app.add_flag("--force", options.force,
                     "render even if the path breaks a promise: a hard limit, marked ! in the audit's output");
    }
    app.add_option("--every", film.every, "only every N-th frame, so a film is N times as fast")
        ->check(whole(1, most_frames))
        ->capture_default_str();
    add_range(app, "segments", film.segments, "A-B, such as 0-9",
              "render only segments A-B (60 frames each, from 0), and do not join them into a film");
    app.add_flag("--stereo", film.picture.stereo, "side-by-side stereo, the left eye on the left");
    auto* stills = app.add_option("--stills", film.stills, "write still frames to this folder instead of a film");
    add_choice(app, "--still-format", film.picture.format,
               {{"png", ImageFormat::png}, {"jpeg", ImageFormat::jpeg}, {"exr", ImageFormat::exr}},
               "format of stills; exr: linear light and depth, 32 bits a value, without the films' filter")
        ->needs(stills);
    for (CLI::Option* option :
         {app.add_option("--output", film.output, "film: .mp4, .mkv, .webm or .gif")->capture_default_str(),
          app.add_option("--summary", options.summary,
                         "write device, frames and seconds per frame to this file, as JSON"),
          app.add_option("--title", film.title,
                         "first line of the title; without --title and --authors there is no title"),
          app.add_option("--authors", film.authors, "second line of the title")}) {
        option->excludes(stills);
    }
}

// Adds the options of a command, and sets those defaults that depend on the command. Each command has only the options
// that it uses.
void add_options(CLI::App& app, const Registry& registry, Flythrough& options)
{
    options.film.renderer = {.precision = Precision::f32, .mode = Mode::fast};
    if (options.command == Command::plan) {
        options.film.output = "path.json";
        auto* path = app.add_option("PATH", options.film.output, "path file to write")->capture_default_str();
        app.add_option("--output", options.film.output, "path file, instead of PATH")->excludes(path);
    } else {
        app.add_option("PATH", options.path, options.reads_path() ? "path file to read" : "path file to write")
            ->required(options.reads_path());
    }
    if (!options.reads_path()) add_planning(app, options);
    if (options.command != Command::audit) {
        app.add_option("--fps", options.rate,
                       fmt::format("frames per second; the camera keeps its pace (default: {})",
                                   options.reads_path() ? "the path file's" : "30, kept in the path file"))
            ->check(whole(1, most_frames_per_second));
    }
    if (options.command == Command::preview) {
        options.film.output = "preview.mp4";
        options.film.every = 8;
    }
    if (options.command != Command::plan && options.command != Command::audit) add_filming(app, options);
    if (!options.reads_path() || options.command == Command::audit) {
        app.add_option("--json", options.json, "write the audit to this file, as JSON");
    }
    app.add_option("--size", options.size,
                   fmt::format("WxH in pixels, even; 720p, 1080p, 4k or 8k (default {}; equirectangular: 2160x1080)",
                               options.command == Command::preview ? "480x270" : "1920x1080"));
    add_projection_option(app, options.film.picture.projection);
    app.add_option("--samples", options.film.picture.samples, "samples per pixel side, 1 to 8; 2 means 4 per pixel")
        ->check(real(1, 8))
        ->capture_default_str();
    add_backend_option(app, options.backend, registry);
    app.add_option("--device", options.device,
                   "device of that backend, from 0 (default: each MPI rank uses its own GPU)")
        ->check(whole(0, 1'000'000));
    add_precision_options(app, options.film.renderer);
    add_threads_option(app, options.plan.threads);
    add_look_option(app, options.film.picture.look, options.look_file,
                    options.reads_path() ? "the path file's" : "coral");
}

// Sets the pictures' size to that of --size or to the default, which depends on the other options.
void set_size(Flythrough& options)
{
    Picture& picture = options.film.picture;
    const int pictures = picture.stereo ? 2 : 1;
    std::tie(picture.width, picture.height) =
        !options.size.empty() ? size_option(options.size, max_side, panoramas(picture.projection, picture.stereo))
        : picture.projection == Projection::equirectangular ? std::pair{pictures * 2160, 1080}
        : options.command == Command::preview               ? std::pair{480, 270}
                                                            : std::pair{1920, 1080};
    check_panorama(picture.projection, picture.width, picture.height, pictures);
    if (picture.stereo && picture.width % 4 != 0) {
        throw InputError(fmt::format("--stereo: a width of {} given, expected a multiple of 4", picture.width));
    }
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
    if (command == Command::plan || makes_film()) files.push_back({"--output", film.output});
    files.insert(files.end(), {{"--json", json}, {"--map", map}, {"--summary", summary}});
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
    app.set_version_flag("--version", version_line("flythrough"));
    app.require_subcommand(1);
    app.footer(
        "`flythrough COMMAND --help` lists the options of a command.\n"
        "To continue an interrupted film, run the same command again. mpirun distributes the work among its ranks.\n"
        "Exit codes: 0 success, 1 failure or a broken promise, 2 wrong arguments or bad input, 77 backend not "
        "available." +
        environment_help("flythrough"));
    std::array<Flythrough, std::size(commands)> all;
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].command = commands[i].command;
        add_options(*app.add_subcommand(commands[i].name, commands[i].about), registry, all[i]);
    }
    done = parse_arguments(app, "flythrough", argc, argv);
    if (done) return {};
    const auto* const chosen =
        std::ranges::find(commands, app.get_subcommands().front()->get_name(), &CommandName::name);
    Flythrough options = all[static_cast<std::size_t>(chosen - commands)];
    fractal_named(options.fractal);
    constexpr int usual_seconds = 240;
    if (options.frames == 0) options.frames = usual_seconds * options.rate;
    set_size(options);
    options.film.renderer.device = options.device.value_or(0);
    check_seconds(options);
    options.path = options.reads_path() ? input_name(options.path) : output_name(options.path);
    options.parameters = input_name(options.parameters);
    for (std::string* file : {&options.film.output, &options.json, &options.map, &options.summary})
        *file = output_name(*file);
    return options;
}

}  // namespace mandelmarch
