// SPDX-License-Identifier: Apache-2.0
// flythrough: plans a flight through a fractal, audits it and renders it as a film.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "apps/cli/options.h"
#include "apps/flythrough_options.h"
#include "backends/all.h"
#include "core/os/cores.h"
#include "core/os/files.h"
#include "core/os/output_file.h"
#include "core/os/program.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "flight/audit/audit.h"
#include "flight/film/convergence.h"
#include "flight/film/description.h"
#include "flight/film/encoder.h"
#include "flight/film/film.h"
#include "flight/film/segment_store.h"
#include "flight/path/path.h"
#include "flight/ride/planner.h"

namespace {

using namespace mandelmarch;

constexpr std::size_t long_flight = 20'000;  // frames; a message announces the audit of a longer flight

void tell_audit(const Path& path)
{
    if (path.frames.size() >= long_flight) say("audit: {} frames\n", path.frames.size());
}

// Returns true if stdout is redirected to this file; false for a terminal or another character device.
bool goes_to_stdout(const std::string& file)
{
    struct stat named {};
    struct stat standard {};
    return stat(file.c_str(), &named) == 0 && fstat(STDOUT_FILENO, &standard) == 0 && !S_ISCHR(standard.st_mode) &&
           named.st_dev == standard.st_dev && named.st_ino == standard.st_ino;
}

// Audits the path, prints the result and writes it to the file of --json, if given. Prints to stdout, or to stderr if
// an output file goes to stdout. Returns true if every promise (a hard limit) is kept.
bool show_audit(const Flythrough& options, const Path& path, double planning, const Backend& backend)
{
    tell_audit(path);
    Audit result = audit(path, options.plan.threads);
    std::ranges::move(truth_rows(path, backend, options.film.renderer, options.film.picture),
                      std::inserter(result.rows, std::ranges::find(result.rows, false, &Row::promise)));
    const auto taken = options.written();
    if (std::ranges::any_of(taken, [](const NamedFile& file) { return goes_to_stdout(file.path); })) {
        say("{}", table_of(path, result));
    } else {
        print("{}", table_of(path, result));
        flush_stdout();
    }
    if (!options.json.empty()) write_file(options.json, json_of(path, result, planning));
    return result.promises_kept();
}

void write_map(const Flythrough& options, const Plan& made)
{
    if (!options.map.empty()) write_file(options.map, map_of(made, options.plan.threads));
}

// Reads the files that describe a plan. Throws InputError as read_plan() does, or if an output file cannot be written
// or is the same as another file. Called before any work is done.
void check_files(Flythrough& options)
{
    std::vector<NamedFile> files = options.written();
    if (options.makes_film() && !OutputFile::is_stream(options.film.output)) {
        files.push_back({"the stamp of --output", stamp_path(end_of_links(options.film.output))});
        files.push_back({"the segments of --output", parts_folder(options.film.output, "")});
    }
    refuse_shared_files(files, options.read());
    for (const NamedFile& file : options.written()) {
        if (!file.path.empty()) OutputFile::check(file.path);
    }
    if (!options.reads_path()) options.plan = read_plan(options);
}

int plan_command(const Flythrough& options, const Backend& backend)
{
    const Plan made = make_plan(options);
    write_file(options.film.output, to_text(made.path));
    write_map(options, made);
    return show_audit(options, made.path, made.seconds, backend) ? exit_success : exit_failure;
}

// Returns the number of threads that one of `local` processes on this machine should use: Cores::threads(), divided by
// `local` if this process may run on all cores and OMP_NUM_THREADS is not set.
int threads_for(int local)
{
    const Cores mine = cores();
    // A limit by processor affinity or OMP_NUM_THREADS already applies to each rank, so it is not divided.
    if (mine.asked || mine.given < mine.machine) return mine.threads();
    return std::max(1, mine.threads() / std::max(1, local));
}

// Returns the renderer's options for this rank. The ranks on a machine use different GPUs, if there are several, and
// share the machine's cores.
RendererOptions renderer_of(const Flythrough& options, const Backend& backend, const Ranks& ranks)
{
    RendererOptions renderer = options.film.renderer;
    renderer.counts = false;
    renderer.threads = options.plan.threads > 0 ? options.plan.threads : threads_for(ranks.local_size());
    std::vector<int> gpus;
    const std::vector<Device> devices = backend.devices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        if (devices[i].is_gpu) gpus.push_back(static_cast<int>(i));
    }
    if (!options.device && !gpus.empty()) {
        renderer.device = gpus[static_cast<std::size_t>(ranks.local_rank()) % gpus.size()];
    }
    return renderer;
}

void refuse_broken(const Path& path, const Flythrough& options)
{
    tell_audit(path);
    const Audit result = audit_promises(path, options.plan.threads);
    if (result.promises_kept()) return;
    say("{}", table_of(path, result));
    if (!options.force) throw Error("the path breaks a promise and is not rendered, unless --force is given");
}

// Throws InputError if the film or the stills cannot be made. Called before any work is done.
void check_pictures(const FilmOptions& film, std::size_t frames, int rate)
{
    if (film.stills.empty()) {
        check_film(film, frames, rate);
    } else {
        check_stills(film, frames);
    }
}

// Chooses the frames of the options' part of a path. For a film with --every N, replaces the path by every N-th of the
// chosen frames. Throws InputError if the path does not have all chosen frames.
void choose_frames(Path& path, Flythrough& options)
{
    FilmOptions& film = options.film;
    if (!options.part.whole()) film.frames = frames_of(path, options.part, options.plan.threads);
    if (film.every == 1 || !film.stills.empty()) return;
    const auto [first, last] = chosen_frames(film.frames, path.frames.size());
    std::vector<Frame> kept;
    for (std::size_t at = first; at <= last; at += film.every) kept.push_back(path.frames[at]);
    path.frames = std::move(kept);
    path.every = static_cast<int>(film.every);
    film.frames.reset();
}

// Plans or reads the path, and chooses its frames. Called on rank 0 only.
Path path_of(Flythrough& options, const Backend& backend)
{
    const FilmOptions& film = options.film;
    if (film.stills.empty()) check_ffmpeg(container_of(film.output));
    if (options.reads_path()) {
        const Path whole = read_path(options.path);
        Path path = options.rate > 0 ? at_rate(whole, std::numeric_limits<int>::max(), options.rate) : whole;
        choose_frames(path, options);
        check_pictures(film, path.frames.size(), path.frames_per_second);
        refuse_broken(whole, options);
        return path;
    }
    const auto frames = static_cast<std::size_t>(options.frames);
    check_pictures(film, film.stills.empty() ? (frames - 1) / film.every + 1 : frames, options.rate);
    Plan made = make_plan(options);
    if (!options.path.empty()) write_file(options.path, to_text(made.path));
    write_map(options, made);
    show_audit(options, made.path, made.seconds, backend);
    choose_frames(made.path, options);
    return std::move(made.path);
}

int render(const Flythrough& options, const Path& path, const Backend& backend, Ranks& ranks)
{
    const FilmOptions& film = options.film;
    if (!film.stills.empty()) {
        const std::size_t pictures = make_stills(path, backend, film, ranks);
        if (ranks.rank() == 0)
            say("stills: {} {} in {}\n", pictures, pictures == 1 ? "picture" : "pictures", film.stills);
        return exit_success;
    }
    const FilmStats report = make_film(path, backend, film, ranks);
    if (ranks.rank() != 0) return exit_success;
    say("film: {} of {} segments rendered in {:.1f} s by {} process{}; {}\n", report.rendered, report.segments,
        report.seconds, ranks.size(), ranks.size() == 1 ? "" : "es",
        report.joined ? film.output + " is complete" : std::string("segments only, the film is not joined"));
    if (!options.summary.empty()) {
        write_file(options.summary, summary_of(path, backend, film, report, ranks.size()));
    }
    return exit_success;
}

int run(const Registry& registry, Flythrough options)
{
    if (options.command == Command::plan || options.command == Command::audit) {
        check_files(options);
        const Backend& backend = chosen_backend(registry, options.backend, true);
        options.film.renderer = renderer_of(options, backend, Ranks());
        static_cast<void>(backend.create(options.film.renderer));
        if (options.command == Command::plan) return plan_command(options, backend);
        return show_audit(options, read_path(options.path), 0, backend) ? exit_success : exit_failure;
    }
    const auto ranks = make_ranks();
    try {
        if (ranks->rank() == 0) check_files(options);
        if (!options.film.segments) refuse_singletons(*ranks);
        const RendererOptions heeded{.threads = options.plan.threads};
        const Backend& backend = chosen_backend(registry, options.backend, ranks->rank() == 0, heeded);
        refuse_unheeded(registry, backend, heeded);
        options.film.renderer = renderer_of(options, backend, *ranks);
        // Throws here, before planning, if the device is missing.
        static_cast<void>(backend.create(options.film.renderer));
        Path path;
        if (ranks->rank() == 0) path = path_of(options, backend);
        if (ranks->size() > 1) {
            const std::string text = ranks->share(ranks->rank() == 0 ? to_text(path) : "");
            if (ranks->rank() != 0) path = path_from_text(text, "the path");
        }
        // With --every, rank 0 has shared the chosen frames alone.
        if (ranks->rank() != 0) {
            if (options.film.every > 1 && options.film.stills.empty()) {
                options.film.frames.reset();
                path.every = static_cast<int>(options.film.every);
            } else {
                choose_frames(path, options);
            }
        }
        return render(options, path, backend, *ranks);
    } catch (const std::exception&) {
        if (ranks->size() == 1) throw;
        // run_program() prints this rank's error and returns its exit code. abort() then ends all ranks.
        const int code = run_program(
            "flythrough", [](int, char**) -> int { std::rethrow_exception(std::current_exception()); }, 0, nullptr);
        ranks->abort(code);
        return code;
    }
}

int body(int argc, char** argv)
{
    // Backends are created first, because they fork processes for drivers. A process must be forked before threads are
    // started and MPI is initialised.
    const Registry registry = program_backends(argc, argv);
    std::optional<int> done;
    const Flythrough options = parse_flythrough(registry, argc, argv, done);
    return done ? *done : run(registry, options);
}

}  // namespace

int flythrough_main(int argc, char** argv) { return mandelmarch::run_program("flythrough", body, argc, argv); }
