// SPDX-License-Identifier: Apache-2.0
// A program of anybody's as a backend: `program:./mine` runs ./mine for each picture, in an empty folder, with a time
// limit. The folder holds the parameter file scene.dat.
//
// A program that takes the options of `render` and writes its statistics is run as
//   PROGRAM scene.dat --fractal NAME --precision P --mode M --output FILE --stats FILE [--without NAMES]
// so its times are those of its statistics, and its pictures in float have values (EXR) where the caller needs them.
// Any other program is foreign. It is run as PROGRAM scene.dat, must write the picture that scene.dat names
// (image.bmp), and is timed as a whole process.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/image/formats/image_file.h"
#include "core/os/child_process.h"
#include "core/os/files.h"
#include "core/os/input_file.h"
#include "core/os/output_file.h"
#include "core/render/backend.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/console.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/json.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* scene_name = "scene.dat";
constexpr const char* stats_name = "stats.json";
constexpr std::size_t longest_complaint = 200;  // bytes of a message that name what a program said
constexpr std::size_t most_complaints = 4096;   // bytes of a program's stderr that are read
constexpr int trial_side = 16;                  // pixels of the picture that shows whether a program is foreign
constexpr double trial_limit = 20;              // seconds

// A program and its first arguments.
struct Command {
    std::string name;  // as given
    std::vector<std::string> words;
    bool foreign = true;
    Device device = {};
};

struct Drawn {
    Image image;
    RenderStats stats;
};

std::string last_line(std::string text)
{
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

// Ends the processes that a program leaves behind, also those of other sessions. When their parents end, they become
// children of this process.
class Leftovers {
public:
    Leftovers() { prctl(PR_SET_CHILD_SUBREAPER, 1); }
    ~Leftovers()
    {
        for (bool found = true; found;) {
            found = false;
            for (const pid_t one : children()) {
                if (before_.contains(one)) continue;
                found = true;
                kill(one, SIGKILL);
                waitpid(one, nullptr, 0);
            }
        }
    }
    Leftovers(const Leftovers&) = delete;
    Leftovers& operator=(const Leftovers&) = delete;

private:
    // Returns this process's children; empty if the system does not list them.
    static std::set<pid_t> children()
    {
        std::set<pid_t> all;
        std::error_code none;
        for (const auto& task : fs::directory_iterator("/proc/self/task", none)) {
            std::ifstream list(task.path() / "children");
            for (pid_t one = 0; list >> one;) all.insert(one);
        }
        return all;
    }

    std::set<pid_t> before_ = children();
};

// Runs the command in the folder. Throws Error, which says how the program ended and what it said last.
Ended run(const Command& command, std::vector<std::string> words, const fs::path& folder, double limit)
{
    const MemoryFile complaints;
    const Leftovers leftovers;
    const Ended ended =
        ChildProcess(
            {.words = std::move(words), .folder = folder.string(), .errors = complaints.number(), .confined = true})
            .end(limit);
    if (ended.code == exit_success && !ended.timed_out) return ended;
    const std::string said = last_line(complaints.text(most_complaints));
    throw Error(fmt::format(
        "{}: {}{}", command.name,
        ended.timed_out ? fmt::format("no end within {:g} s (MANDELMARCH_DEVICE_TIMEOUT)", limit) : ended.text(),
        said.empty() ? "" : ": " + printable(said, longest_complaint)));
}

// Reads the picture that the program has written. Throws Error.
Image picture_in(const Command& command, const fs::path& folder, const std::string& file, const Scene& scene)
{
    const fs::path path = folder / file;
    std::error_code failed;
    if (!fs::is_regular_file(path, failed)) throw Error(fmt::format("{}: no {} written", command.name, file));
    Image image;
    try {
        image = read_image(path.string());
    } catch (const InputError& error) {
        std::string what = error.what();  // starts with the path of a temporary folder
        if (what.starts_with(path.string())) what = file + what.substr(path.string().size());
        throw Error(fmt::format("{}: {}", command.name, what));
    }
    if (image.width() != scene.width || image.height() != scene.height) {
        throw Error(fmt::format("{}: {} has {} x {} pixels, expected {} x {}", command.name, file, image.width(),
                                image.height(), scene.width, scene.height));
    }
    return image;
}

// Returns a number of the statistics. Throws Error if it is not from `least` to 2^53.
double number(const Json& json, const char* key, double least = 0)
{
    const double value = json.at(key).is_number() ? json.at(key).get<double>() : -1;
    if (!(value >= least && value <= 0x1p53)) throw Error(fmt::format("{} is not a number from {:g}", key, least));
    return value;
}

// Reads the statistics that the program has written. Throws Error.
RenderStats stats_in(const Command& command, const fs::path& folder)
{
    const std::optional<std::string> text = own_file((folder / stats_name).string());
    if (!text) throw Error(fmt::format("{}: no {} written", command.name, stats_name));
    try {
        const Json json = parse_json<Json>(*text, stats_name);
        const Json& device = json.at("device");
        const Json& seconds = json.at("seconds");
        const Json& work = json.at("work");
        RenderStats stats;
        stats.device = {.name = device.at("name"),
                        .vendor = device.at("vendor"),
                        .driver = device.at("driver"),
                        .is_gpu = device.at("is_gpu")};
        stats.threads = static_cast<int>(std::min(number(json, "threads"), 1e6));
        stats.simd_width = static_cast<int>(std::min(number(json, "simd_width"), 1e6));
        stats.instruction_set = printable(json.at("instruction_set").get<std::string>());
        stats.unsettled = number(json, "unsettled");
        if (json.at("step_factor").is_number()) stats.step_factor = number(json, "step_factor");
        stats.timings = {.context = number(seconds, "context"),
                         .build = number(seconds, "build"),
                         .upload = number(seconds, "upload"),
                         .kernel = number(seconds, "kernel", 1e-9),
                         .host = number(seconds, "host"),
                         .readback = number(seconds, "readback"),
                         .wall = number(seconds, "wall", 1e-9)};
        stats.work = {.steps = static_cast<std::uint64_t>(number(work, "steps")),
                      .de_calls = static_cast<std::uint64_t>(number(work, "de_calls")),
                      .iterations = static_cast<std::uint64_t>(number(work, "iterations"))};
        return stats;
    } catch (const std::exception& error) {
        throw Error(fmt::format("{}: {}: not the statistics of render: {}", command.name, stats_name,
                                printable(error.what(), longest_complaint)));
    }
}

// Draws the scene. `layers`: of the picture; a foreign program draws bytes alone.
Drawn drawn(const Command& command, Scene scene, const RendererOptions& options, Image::Layers layers, double limit)
{
    const TemporaryFolder folder;
    scene.image_file = "image.bmp";
    write_file((folder.path() / scene_name).string(), to_parameters(scene));
    std::vector<std::string> words = command.words;
    words.emplace_back(scene_name);
    if (command.foreign) {
        const Ended ended = run(command, std::move(words), folder.path(), limit);
        Drawn made{.image = picture_in(command, folder.path(), scene.image_file, scene), .stats = {}};
        made.stats.device = command.device;
        made.stats.threads = made.stats.simd_width = 0;  // unknown
        made.stats.timings.ran(ended.seconds);
        made.stats.timings.wall = ended.seconds;
        return made;
    }
    // An EXR file holds values in float.
    const bool values = layers == Image::Layers::all && options.precision == Precision::f32;
    const std::string file = values ? "image.exr" : scene.image_file;
    for (const std::string& word :
         {std::string("--fractal"), std::string(scene.fractal->name), std::string("--precision"),
          std::string(name_of(options.precision)), std::string("--mode"), std::string(name_of(options.mode)),
          std::string("--output"), file, std::string("--stats"), std::string(stats_name)}) {
        words.push_back(word);
    }
    if (const std::string without = disabled(options.techniques); !without.empty()) {
        words.insert(words.end(), {"--without", without});
    }
    run(command, std::move(words), folder.path(), limit);
    return {picture_in(command, folder.path(), file, scene), stats_in(command, folder.path())};
}

class ProgramRenderer : public Renderer {
public:
    ProgramRenderer(Command command, const RendererOptions& options) : command_(std::move(command)), options_(options)
    {
    }

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        if (image.height() != scene.height) {
            throw Unavailable(fmt::format("{}: a program draws whole pictures only", command_.name));
        }
        if (progress) progress(0);
        Drawn made = drawn(command_, scene, options_, image.layers(), device_timeout());
        image = std::move(made.image);
        made.stats.backend = command_.name;
        made.stats.precision = options_.precision;
        made.stats.mode = options_.mode;
        if (progress) progress(1);
        return made.stats;
    }

private:
    Command command_;
    RendererOptions options_;
};

// The backend of one program.
class Program : public Backend {
public:
    explicit Program(Command command) : command_(std::move(command)) {}

    std::string_view name() const override { return command_.name; }
    BackendInfo info() const override { return {.foreign = command_.foreign, .replays = true}; }
    std::vector<Device> devices() const override { return {command_.device}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        return std::make_unique<ProgramRenderer>(command_, options);
    }

private:
    Command command_;
};

// Splits the text into a program and its first arguments, at blanks. A text that names a file is the program.
Command command_of(const std::string& text)
{
    Command command{.name = "program:" + text, .words = {text}};
    std::error_code failed;
    if (!fs::is_regular_file(text, failed)) {
        std::istringstream stream(text);
        command.words.clear();
        for (std::string word; stream >> word;) command.words.push_back(word);
    }
    if (command.words.empty() || !fs::is_regular_file(command.words[0], failed) ||
        access(command.words[0].c_str(), X_OK) != 0) {
        throw InputError(fmt::format(
            "--backend: '{}' given, expected an executable file that runs as PROGRAM {} and writes a picture",
            command.name, scene_name));
    }
    command.words[0] = fs::absolute(command.words[0]).string();
    command.device = {.name = text, .vendor = "", .driver = "timed as a whole process", .is_gpu = false};
    return command;
}

// The backend `program`, which makes a backend of each program.
class Programs : public Backend {
public:
    std::string_view name() const override { return "program"; }
    BackendInfo info() const override { return {.argument = "PROGRAM"}; }
    std::optional<std::string> unavailable() const override { return "expected program:PROGRAM"; }
    std::vector<Device> devices() const override { return {}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions&) const override { throw Unavailable(*unavailable()); }

    std::unique_ptr<Backend> with_argument(const std::string& text) const override
    {
        Command command = command_of(text);
        command.foreign = false;
        try {
            const Scene scene = official_scene(fractals().front(), trial_side, trial_side);
            command.device =
                drawn(command, scene, {}, Image::Layers::bytes, std::min(trial_limit, device_timeout())).stats.device;
            command.device.name = printable(command.device.name, longest_complaint);
            command.device.driver = "by the program's own clock";
        } catch (const Error& error) {
            command.foreign = true;
            say("{}; it is timed as a whole process\n", printable(error.what(), 2 * longest_complaint));
        }
        return std::make_unique<Program>(std::move(command));
    }
};

}  // namespace

std::unique_ptr<Backend> make_program_backend() { return std::make_unique<Programs>(); }

}  // namespace mandelmarch
