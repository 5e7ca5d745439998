// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>
#include <tuple>

#include "cli/option_values.h"
#include "bench/contest/race.h"
#include "bench/machine/environment.h"
#include "bench/harness/verify.h"
#include "bench/machine/steadiness.h"
#include "bench/study/cases.h"
#include "core/base/child_process.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/output_file.h"
#include "core/base/text.h"
#include "core/image/compare.h"
#include "core/image/formats/image_file.h"
#include "core/render/agreement.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace mandelmarch::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* scene_name = "scene.dat";
constexpr const char* image_name = "image.bmp";
constexpr std::size_t longest_complaint = 200;  // bytes
constexpr std::size_t most_complaints = 4096;   // bytes of a program's stderr that are read
// For a round's view the eye moves by a fraction of its distance to the target. The fraction starts at first_move. It
// is doubled until at least least_change of the pixels differ visibly from the official picture, or until it exceeds
// last_move.
constexpr double first_move = 0.01;
constexpr double last_move = 0.1;
constexpr double least_change = 0.1;

std::string last_line(std::string text)
{
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

std::string absolute_program(const std::string& program)
{
    std::error_code failed;
    if (!fs::is_regular_file(program, failed) || access(program.c_str(), X_OK) != 0) {
        throw InputError(fmt::format(
            "bench race: {}: no program, expected a file that runs as PROGRAM scene.dat and writes a picture",
            program));
    }
    return fs::absolute(program).string();
}

Scene scene_of(const RaceOptions& options)
{
    if (!options.scene.empty() && options.fractal == nullptr) {
        throw InputError("bench race: --scene without --fractal given, expected the fractal that the file is of");
    }
    const Fractal& fractal = options.fractal == nullptr ? fractals().front() : *options.fractal;
    constexpr int side = 540;  // pixels
    Scene scene = official_scene(fractal, side, side);
    if (!options.scene.empty()) scene = read_parameters(options.scene, fractal).scene;
    if (options.size) std::tie(scene.width, scene.height) = *options.size;
    scene.image_file = image_name;
    return scene;
}

// Returns the scene with its eye moved in a random direction by the fraction `share` of its distance to the target.
Scene moved(const Scene& scene, double share, std::mt19937_64& chance)
{
    std::normal_distribution<double> normal;
    const Vector to{normal(chance), normal(chance), normal(chance)};
    const double x = scene.eye.x - scene.target.x;
    const double y = scene.eye.y - scene.target.y;
    const double z = scene.eye.z - scene.target.z;
    const double scale = share * std::hypot(x, y, z) / std::hypot(to.x, to.y, to.z);
    Scene other = scene;
    other.eye = {scene.eye.x + scale * to.x, scene.eye.y + scale * to.y, scene.eye.z + scale * to.z};
    return other;
}

class RunningRace {
public:
    RunningRace(const RaceOptions& options, const std::function<void(double)>& progress)
        : options_(options), progress_(progress), scene_(scene_of(options)), random_(options.seed)
    {
        race_.fractal = scene_.fractal->name;
        race_.width = scene_.width;
        race_.height = scene_.height;
        race_.parameters = to_parameters(scene_);
        race_.limit = options.limit;
        race_.rounds = options.rounds;
        const fs::path render = fs::read_symlink("/proc/self/exe").parent_path() / "render";
        const auto ours = [&](const std::string& backend, std::vector<std::string> more) {
            std::vector<std::string> words{render.string(), scene_name, "--fractal", race_.fractal,
                                           "--backend",     backend,    "--output",  image_name};
            words.insert(words.end(), more.begin(), more.end());
            return words;
        };
        if (access(render.c_str(), X_OK) != 0) {
            throw InputError(fmt::format("bench race: {}: not found, expected our renderer in the folder of bench",
                                         render.string()));
        }
        expected_ = ours("openmp", {"--simd-width", "1"});
        race_.racers.push_back({.name = "mandelmarch " + options.backend, .ours = true});
        words_.push_back(ours(options.backend, {}));
        for (const std::string& program : options.programs) {
            race_.racers.push_back({.name = program});
            words_.push_back({absolute_program(program), scene_name});
        }
    }

    Race run()
    {
        const Steadiness steadiness;
        view_ = {race_.parameters, expected(race_.parameters)};
        const Image official = view_.expected;
        std::vector<std::size_t> timed;
        for (std::size_t i = 0; i < words_.size(); ++i) {
            progress_(0.5 * static_cast<double>(i) / static_cast<double>(words_.size()));
            RacedProgram& racer = race_.racers[i];
            const Drawn first = draw(racer, words_[i]);
            if (first.image) judge(racer, *first.image);
            if (!is_right(racer.verdict)) continue;
            if (first.sample.seconds > longest_repeated) {
                racer.samples.push_back(first.sample);
            } else {
                timed.push_back(i);
            }
        }
        for (int round = 0; round < options_.rounds; ++round) {
            view_ = another_view(official);
            std::ranges::shuffle(timed, random_);
            for (const std::size_t i : timed) again(i, round);
            progress_(0.5 + 0.5 * (round + 1) / options_.rounds);
        }
        for (std::string& warning : steadiness.warnings({})) race_.warnings.push_back(std::move(warning));
        return std::move(race_);
    }

private:
    struct Drawn {
        std::optional<Image> image;
        RaceSample sample;
    };

    // A parameter file to render, and the scalar kernel's picture of it.
    struct View {
        std::string parameters;
        Image expected;
    };

    Image expected(const std::string& parameters)
    {
        RacedProgram scalar{.name = "the scalar kernel", .ours = true};
        view_.parameters = parameters;
        Drawn drawn = draw(scalar, expected_);
        if (!drawn.image) throw Error(fmt::format("bench race: our own picture: {}", scalar.why));
        return std::move(*drawn.image);
    }

    // Returns a new view whose picture differs visibly from `official`, so that a program cannot use a picture that it
    // kept from an earlier run. If all nearby views look like `official`, adds a warning.
    View another_view(const Image& official)
    {
        for (double share = first_move;; share *= 2) {
            View view{to_parameters(moved(scene_, share, chance_)), {}};
            view.expected = expected(view.parameters);
            const Comparison change = compare(official, view.expected);
            const bool visible =
                static_cast<double>(change.visibly_differing) >= least_change * static_cast<double>(change.pixels);
            if (visible) return view;
            if (share > last_move) {
                const std::string blind =
                    "pictures of nearby views do not differ visibly: one kept from an earlier run is not noticed";
                if (std::ranges::find(race_.warnings, blind) == race_.warnings.end()) race_.warnings.push_back(blind);
                return view;
            }
        }
    }

    // Runs the program once on the current view. If it leaves no picture, sets the racer's verdict and reason.
    Drawn draw(RacedProgram& racer, const std::vector<std::string>& words)
    {
        const TemporaryFolder folder;
        const fs::path& work = folder.path();
        write_file((work / scene_name).string(), view_.parameters);
        const auto fails = [&](RaceVerdict verdict, std::string why) {
            racer.verdict = verdict;
            racer.why = std::move(why);
            return Drawn{};
        };
        const MemoryFile complaints;
        Ended ended;
        try {
            ended = ChildProcess({.words = words,
                                  .program = words[0],
                                  .folder = work.string(),
                                  .errors = complaints.number(),
                                  .confined = true})
                        .end(options_.limit);
        } catch (const Error& error) {
            return fails(RaceVerdict::no_start, error.what());
        }
        (ended.signal == 0 ? racer.exit_code : racer.signal) = ended.signal == 0 ? ended.code : ended.signal;
        racer.memory = std::max(racer.memory, ended.memory);
        const std::string complaint = last_line(complaints.text(most_complaints));
        const std::string said = complaint.empty() ? "" : fmt::format(": {}", printable(complaint, longest_complaint));
        if (ended.timed_out)
            return fails(RaceVerdict::hung, fmt::format("no end within {:g} s{}", options_.limit, said));
        if (ended.signal != 0) {
            return fails(RaceVerdict::crashed,
                         fmt::format("ended by signal {}, {}{}", ended.signal, sigdescr_np(ended.signal), said));
        }
        if (ended.code != exit_success)
            return fails(RaceVerdict::failed, fmt::format("exit code {}{}", ended.code, said));
        const fs::path picture = work / image_name;
        if (!fs::is_regular_file(picture)) return fails(RaceVerdict::no_picture, "no " + what_is_left(work) + said);
        Drawn drawn{.image = {}, .sample = {.seconds = ended.seconds, .processor = ended.processor}};
        try {
            drawn.image = read_image(picture.string());
        } catch (const InputError& error) {
            std::string what = error.what();  // starts with the path of a temporary folder
            if (what.starts_with(picture.string())) what = image_name + what.substr(picture.string().size());
            return fails(RaceVerdict::no_image, what);
        }
        return drawn;
    }

    static std::string what_is_left(const fs::path& folder)
    {
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (name != scene_name) return fmt::format("{}, but {}", image_name, printable(name, longest_complaint));
        }
        return image_name;
    }

    void judge(RacedProgram& racer, const Image& image)
    {
        const Image& expected = view_.expected;
        if (image.width() != expected.width() || image.height() != expected.height()) {
            racer.verdict = RaceVerdict::wrong_size;
            racer.why = fmt::format("{} x {} pixels, expected {} x {}", image.width(), image.height(), expected.width(),
                                    expected.height());
            return;
        }
        const Comparison found = compare(expected, image);
        RacePicture picture{.width = image.width(),
                            .height = image.height(),
                            .differing = found.differing,
                            .visibly_differing = found.visibly_differing,
                            .psnr = found.psnr};
        if (found.first >= 0) {
            picture.first_x = static_cast<int>(found.first % image.width());
            picture.first_y = static_cast<int>(found.first / image.width());
        }
        racer.picture = picture;
        const double percent = 100.0 * static_cast<double>(found.visibly_differing) / static_cast<double>(found.pixels);
        racer.verdict = found.same()                      ? RaceVerdict::same
                        : percent <= most_visible_percent ? RaceVerdict::close
                                                          : RaceVerdict::wrong;
        if (racer.verdict == RaceVerdict::wrong) {
            racer.why = fmt::format("{} of {} pixels differ, {} visibly, the first at {},{}", found.differing,
                                    found.pixels, found.visibly_differing, picture.first_x, picture.first_y);
        }
    }

    // Runs a program on the round's view and checks its picture. Does nothing if an earlier picture of this program was
    // wrong.
    void again(std::size_t i, int round)
    {
        RacedProgram& racer = race_.racers[i];
        if (!is_right(racer.verdict)) return;
        Drawn drawn = draw(racer, words_[i]);
        if (!drawn.image) return;
        const RaceVerdict first = racer.verdict;
        const std::optional<RacePicture> picture = racer.picture;
        judge(racer, *drawn.image);
        if (!is_right(racer.verdict)) {
            racer.verdict = RaceVerdict::unsteady;
            racer.why = fmt::format("round {}, another view: {}", round, racer.why);
            return;
        }
        racer.verdict = std::max(first, racer.verdict);
        racer.picture = picture;
        drawn.sample.round = round;
        racer.samples.push_back(drawn.sample);
    }

    const RaceOptions& options_;
    const std::function<void(double)>& progress_;
    Scene scene_;
    std::mt19937_64 random_;                          // for the order of the programs
    std::mt19937_64 chance_{std::random_device{}()};  // for the views, which must be unpredictable
    Race race_;
    std::vector<std::string> expected_;
    std::vector<std::vector<std::string>> words_;  // command line of each racer
    View view_;                                    // current view
};

}  // namespace

Race run_race(const RaceOptions& options, const Registry& registry, const std::function<void(double)>& progress)
{
    RunningRace running(options, progress);
    Race race = running.run();
    race.environment = environment(registry);
    return timed(std::move(race));
}

}  // namespace mandelmarch::bench
