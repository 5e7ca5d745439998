// flythrough: plans a flight through a fractal, audits it and makes a film of it.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <vector>

#include "apps/flythrough_options.h"
#include "backends/all.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "flight/audit/audit.h"
#include "flight/audit/map.h"
#include "flight/film/film.h"
#include "flight/film/summary.h"
#include "flight/plan/planner.h"

namespace {

using namespace mandelmarch;

void write_text(const std::string& file, const std::string& text)
{
    OutputFile output(file);
    output.write(text.data(), text.size());
    output.commit();
}

// The scene whose fractal is flown through: a parameter file, or the fractal's usual one.
Scene scene_of(const Flythrough& options)
{
    const Fractal& fractal = fractal_named(options.fractal);
    const auto usual = [&] {
        if (fractal.nickname == "bulb") return "7 7 7\n0 0 0\n0 1 0\n1\n16 9\n-3\n0 4 8\n100 0\n0\n1.2\nfilm.bmp\n";
        if (fractal.nickname == "box") return "14 8 10\n0 0 0\n0 1 0\n1\n16 9\n-3\n2 0.5 1\n18 100\n0\n1.2\nfilm.bmp\n";
        return "2 2 2\n0 0 0\n0 1 0\n1\n16 9\n-3\n-0.291 -0.399 0.339\n60 0.437\n0\n1.2\nfilm.bmp\n";
    };
    Scene scene = options.parameters.empty() ? parse_parameters(usual(), fractal.name.data(), fractal).scene
                                             : read_parameters(options.parameters, fractal).scene;
    scene.colouring = options.look.value_or(film_look);
    return scene;
}

// Tells stderr what planning does, one line for each step; tables of tours that were not taken are left out.
void log_plan(const std::string& text) { fmt::print(stderr, "plan: {}\n", text.substr(0, text.find('\n'))); }

Plan make_plan(const Flythrough& options)
{
    return plan(scene_of(options), options.seed, options.frames, options.threads, log_plan);
}

// Prints the audit on stdout and, if asked for, as JSON into a file; true if every promise is kept.
bool show_audit(const Flythrough& options, const Path& path, double planning)
{
    const Audit result = audit(path, options.threads, planning);
    fmt::print("{}", table_of(path, result));
    if (!options.json.empty()) write_text(options.json, json_of(path, result));
    return result.promises_kept();
}

void write_map(const Flythrough& options, const Plan& made)
{
    if (!options.map.empty()) write_text(options.map, map_of(made.path, made.balls, made.gates, options.threads));
}

int plan_command(const Flythrough& options)
{
    const std::string output = options.output.empty() ? "path.json" : options.output;
    OutputFile::check(output);
    const Plan made = make_plan(options);
    write_text(output, to_text(made.path));
    write_map(options, made);
    return show_audit(options, made.path, made.seconds) ? exit_fine : exit_failure;
}

const Backend& choose_backend(const Registry& registry, const Flythrough& options, bool say)
{
    if (options.backend != "auto") return *registry.find(options.backend);
    const AutomaticChoice choice = registry.automatic();
    if (say) fmt::print(stderr, "backend {}: {}\n", choice.backend->name(), choice.reason);
    return *choice.backend;
}

// Each rank takes its own GPU where there are some, and its share of the machine's cores.
RendererOptions renderer_of(const Flythrough& options, const Backend& backend, const Ranks& ranks)
{
    RendererOptions renderer = options.renderer;
    renderer.counts = false;
    renderer.threads = options.threads > 0 ? options.threads : threads_for(ranks.local_size());
    std::vector<int> gpus;
    const std::vector<Device> devices = backend.devices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (devices[i].is_gpu) gpus.push_back(static_cast<int>(i));
    }
    if (!options.device_given && !gpus.empty()) {
        renderer.device = gpus[static_cast<std::size_t>(ranks.local_rank()) % gpus.size()];
    }
    return renderer;
}

void refuse_broken(const Path& path, const Flythrough& options)
{
    const Audit result = audit_promises(path, options.threads);
    if (result.promises_kept()) return;
    fmt::print(stderr, "{}", table_of(path, result));
    if (!options.force) throw Error("the path breaks a promise and is not rendered, unless --force is given");
}

int render(const Flythrough& options, const Path& path, Ranks& ranks)
{
    const Registry registry = all_backends(Drivers::isolated);
    const Backend& backend = choose_backend(registry, options, ranks.rank() == 0);
    const RendererOptions renderer = renderer_of(options, backend, ranks);
    const Picture picture{options.width, options.height, options.samples, options.look};
    if (!options.stills.empty()) {
        const auto [first, last] = options.frames_asked(path.frames.size());
        const std::size_t written = make_stills(
            path, backend, {options.stills, options.jpeg, first, last, options.every, picture, renderer}, ranks);
        if (ranks.rank() == 0) fmt::print(stderr, "stills: {} pictures in {}\n", written, options.stills);
        return exit_fine;
    }
    FilmOptions film;
    film.output = options.output.empty() ? "video.mp4" : options.output;
    film.title = options.title;
    film.authors = options.authors;
    film.picture = picture;
    film.renderer = renderer;
    film.segments = options.segments;
    const FilmReport report = make_film(path, backend, film, ranks);
    if (ranks.rank() != 0) return exit_fine;
    fmt::print(stderr, "film: {} of {} segments rendered in {:.1f} s by {} process{}; {}\n", report.rendered,
               report.segments, report.seconds, ranks.size(), ranks.size() == 1 ? "" : "es",
               report.joined ? film.output + " is complete" : std::string("segments only, the film is not joined"));
    if (!options.summary.empty()) {
        write_text(options.summary, summary_of(path, backend, film, report, ranks.size()));
    }
    return exit_fine;
}

int run(const Flythrough& options)
{
    switch (options.command) {
        case Command::plan: return plan_command(options);
        case Command::audit: return show_audit(options, read_path(options.path), 0) ? exit_fine : exit_failure;
        case Command::render:
        case Command::film: break;
    }
    const auto ranks = make_ranks();
    try {
        std::string text;
        if (ranks->rank() == 0) {
            if (options.stills.empty()) check_film_tools();
            if (options.command == Command::film) {
                const Plan made = make_plan(options);
                if (!options.path.empty()) write_text(options.path, to_text(made.path));
                write_map(options, made);
                show_audit(options, made.path, made.seconds);
                std::fflush(stdout);
                text = to_text(made.path);
            } else {
                const Path path = read_path(options.path);
                refuse_broken(path, options);
                text = to_text(path);
            }
        }
        text = ranks->share(text);
        return render(options, path_from_text(text, options.path.empty() ? "the path" : options.path), *ranks);
    } catch (const std::exception&) {
        if (ranks->size() == 1) throw;
        // One rank's failure ends them all; its message comes first.
        const int code = run_program(
            "flythrough", [](int, char**) -> int { std::rethrow_exception(std::current_exception()); }, 0, nullptr);
        ranks->abort(code);
        return code;
    }
}

int body(int argc, char** argv)
{
    std::optional<int> done;
    const Flythrough options = parse_flythrough(argc, argv, done);
    return done ? *done : run(options);
}

}  // namespace

int main(int argc, char** argv) { return mandelmarch::run_program("flythrough", body, argc, argv); }
