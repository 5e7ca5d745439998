// SPDX-License-Identifier: Apache-2.0
// demo: draws the official scenes that reference draws on every backend, in both precisions and modes, proves that the
// pictures agree and prints a table of times. Exit code 1 where a picture fails.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>

#include "backends/all.h"
#include "core/base/console.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "core/base/version.h"
#include "core/image/compare.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace {

using namespace mandelmarch;

constexpr int side = 540;       // pixels
constexpr int repetitions = 5;  // the table shows the fastest

// Most pixels, in a hundred, that may be visibly off the reference picture of the same mode. Exact double is the
// reference's own schedule.
double allowed_percent(const Scene& scene, const RendererOptions& options)
{
    if (options.mode == Mode::fast) return 2;
    const FractalStudy& study = scene.fractal->study;
    return options.precision == Precision::f64 ? study.off_in_double : study.off_in_float;
}

class Demo {
public:
    // Draws, compares and prints one row; false where the picture fails.
    bool row(const Backend& backend, const Scene& scene, const RendererOptions& options)
    {
        const std::string head = fmt::format("{:<11} {:<10} {:<7} {:<6} ", scene.fractal->name,
                                             fmt::format("{}{}", backend.name(), options.pack == 1 ? " 1" : ""),
                                             name_of(options.precision), name_of(options.mode));
        const bool is_reference = backend.facts().role == Role::reference;
        RenderReport report;
        Image image;
        try {
            const auto renderer = backend.create(options);
            image = Image(scene.width, scene.height, Image::Layers::all);
            report = renderer->render(scene, image);
            for (int i = 1; i < (is_reference ? 1 : repetitions); ++i) {
                report.timings.wall = std::min(report.timings.wall, renderer->render(scene, image).timings.wall);
            }
        } catch (const Unavailable& error) {
            print("{}unavailable: {}\n", head, error.what());
            return true;
        } catch (const Error& error) {
            print("{}FAILED: {}\n", head, error.what());
            return false;
        }
        const auto key = std::pair(scene.fractal->name, options.mode);
        if (is_reference) reference_[key] = {image, report.timings.wall};
        const auto& [expected, ignored] = reference_.at(key);
        const double seconds = reference_.at({scene.fractal->name, Mode::exact}).second;
        if (is_reference) {
            print("{}{:9.1f} {:>9.2f}   yardstick\n", head, 1e3 * report.timings.wall, seconds / report.timings.wall);
            return true;
        }
        const Comparison c = compare(expected, image);
        const double percent = 100.0 * static_cast<double>(c.visibly_differing) / static_cast<double>(c.pixels);
        bool fine = percent <= allowed_percent(scene, options);
        std::string proof = fmt::format("{:.3f} % off the reference", percent);
        if (options.mode == Mode::exact) {
            // All backends draw the same bits in exact mode; the first one to draw sets them.
            const auto [first, is_first] = exact_.try_emplace({scene.fractal->name, options.precision}, image);
            const bool same = compare(first->second, image).same();
            fine = fine && same;
            proof += is_first ? "" : same ? ", same bits" : ", OTHER BITS";
        }
        if (fine) {
            print("{}{:9.1f} {:>9.2f}   {}\n", head, 1e3 * report.timings.wall, seconds / report.timings.wall, proof);
        } else {
            print("{}{:>9} {:>9}   FAILED: {}\n", head, "-", "-", proof);
        }
        return fine;
    }

private:
    std::map<std::pair<std::string_view, Mode>, std::pair<Image, double>> reference_;
    std::map<std::pair<std::string_view, Precision>, Image> exact_;
};

int body(int argc, char** argv)
{
    if (argc == 2 && std::string_view(argv[1]) == "--version") {
        print("{}\n", version_line("demo"));
        return exit_fine;
    }
    if (argc > 1) throw InputError("demo: it takes no arguments but --version");
    const Registry registry = all_backends(Drivers::isolated);
    print("{}, {} threads\n", cpu_name(), std::thread::hardware_concurrency());
    print("{} x {} pixels; fastest of {} pictures; speed-up over {}, exact; {} 1: the text as scalar C++\n", side, side,
          repetitions, registry.with(Role::reference).name(), registry.with(Role::host).name());
    print("{:<11} {:<10} {:<7} {:<6} {:>9} {:>9}   {}\n", "fractal", "backend", "number", "mode", "wall ms", "speed-up",
          "picture");
    Demo demo;
    bool fine = true;
    for (const Fractal& fractal : fractals()) {
        const Scene scene = official_scene(fractal, side, side);
        if (!registry.find("reference")->draws(scene)) continue;
        for (const auto& backend : registry.backends()) {
            const Role role = backend->facts().role;
            const Listing listing = listing_of(*backend);
            if (listing.devices.empty()) {
                fine = fine && listing.failure.empty();
                print("{:<11} {:<10} {}{}\n", fractal.name, backend->name(),
                      listing.failure.empty() ? "unavailable: " : "FAILED: ", listing.unavailable + listing.failure);
                continue;
            }
            for (const Mode mode : {Mode::exact, Mode::fast}) {
                for (const Precision precision : {Precision::f64, Precision::f32}) {
                    if (role == Role::reference && precision == Precision::f32) continue;
                    fine = demo.row(*backend, scene, {.precision = precision, .mode = mode}) && fine;
                    if (role != Role::host) continue;
                    fine = demo.row(*backend, scene, {.precision = precision, .mode = mode, .pack = 1}) && fine;
                }
            }
        }
    }
    return fine ? exit_fine : exit_failure;
}

}  // namespace

int main(int argc, char** argv) { return mandelmarch::run_program("demo", body, argc, argv); }
