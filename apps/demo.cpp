// SPDX-License-Identifier: Apache-2.0
// demo: renders official scenes on every backend in both precisions and both modes, verifies that the pictures agree
// and prints a table of times. Scenes that the backend `reference` does not support are left out. The exit code is 1 if
// a picture differs too much or a device fails.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "apps/demo_folder.h"
#include "cli/arguments.h"
#include "cli/option_values.h"
#include "backends/all.h"
#include "core/base/console.h"
#include "core/base/cores.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "core/base/version.h"
#include "core/image/compare.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace {

using namespace mandelmarch;

constexpr int repetitions = 5;  // largest number of pictures per row; the table shows the fastest
// Seconds after which no more pictures are rendered for a row. A second picture is always rendered, because drivers
// compile kernels during the first one.
constexpr double enough = 1.0;

// Returns the percentage of pixels that may differ visibly from the reference's picture in the same mode.
double allowed_percent(const Scene& scene, const RendererOptions& options)
{
    if (options.mode == Mode::fast) return 2;
    const FractalStudy& study = scene.fractal->study;
    return options.precision == Precision::f64 ? study.off_in_double : study.off_in_float;
}

class Demo {
public:
    Demo(int side, const std::string& folder) : side_(side), folder_(folder) {}

    // Renders a picture, compares it and prints the row.
    void row(const Backend& backend, const Scene& scene, const RendererOptions& options)
    {
        DemoRow row;
        row.fractal = scene.fractal->name;
        row.backend = backend.name();
        row.simd_width = options.simd_width;
        row.precision = options.precision;
        row.mode = options.mode;
        draw(row, backend, scene, options);
        rows_.push_back(row);
        const std::string head = fmt::format("{:<11} {:<13} {:<9} {:<5} ", row.fractal,
                                             fmt::format("{}{}", row.backend, row.simd_width == 1 ? "-scalar" : ""),
                                             name_of(row.precision), name_of(row.mode));
        if (!row.drawn) {
            print("{}{}: {}\n", head, row.ok ? "unavailable" : "FAILED", row.said);
        } else if (row.ok) {
            print("{}{:9.1f} {:>9.2f}   {}\n", head, 1e3 * row.seconds, row.speed_up, row.said);
        } else {
            print("{}{:>9} {:>9}   FAILED: {}\n", head, "-", "-", row.said);
        }
        flush_stdout();
    }

    // Prints the row of a backend that does not have a device.
    void absent(const Backend& backend, const Scene& scene, const Listing& listing)
    {
        DemoRow row;
        row.fractal = scene.fractal->name;
        row.backend = backend.name();
        row.ok = listing.failure.empty();
        row.said = listing.unavailable + listing.failure;
        rows_.push_back(row);
        print("{:<11} {:<13} {}: {}\n", row.fractal, row.backend, row.ok ? "unavailable" : "FAILED", row.said);
    }

    // Writes the table; returns true if no row failed.
    bool finish() const
    {
        folder_.table(rows_, side_, repetitions);
        return std::all_of(rows_.begin(), rows_.end(), [](const DemoRow& row) { return row.ok; });
    }

private:
    void draw(DemoRow& row, const Backend& backend, const Scene& scene, const RendererOptions& options)
    {
        const bool is_reference = backend.info().role == Role::reference;
        Image image;
        try {
            const auto renderer = backend.create(options);
            image = Image(scene.width, scene.height, Image::Layers::all);
            const RenderStats report = renderer->render(scene, image);
            row.device = report.device.name;
            row.seconds = report.timings.wall;
            double spent = report.timings.wall;
            for (int i = 1; i < repetitions && !is_reference && (i == 1 || spent < enough); ++i) {
                const double wall = renderer->render(scene, image).timings.wall;
                row.seconds = std::min(row.seconds, wall);
                spent += wall;
            }
        } catch (const Unavailable& error) {
            row.said = error.what();
            return;
        } catch (const Error& error) {
            row.said = error.what();
            row.ok = false;
            return;
        }
        row.drawn = true;
        if (is_reference) reference_[{row.fractal, options.mode}] = {image, row.seconds};
        row.speed_up = reference_.at({row.fractal, Mode::exact}).second / row.seconds;
        if (is_reference) {
            row.said = "expected picture";
        } else {
            prove(row, scene, options, image);
        }
        folder_.picture(row, image);
    }

    void prove(DemoRow& row, const Scene& scene, const RendererOptions& options, const Image& image)
    {
        const Comparison c = compare(reference_.at({row.fractal, options.mode}).first, image);
        const double percent = 100.0 * static_cast<double>(c.visibly_differing) / static_cast<double>(c.pixels);
        row.ok = percent <= allowed_percent(scene, options);
        row.said = fmt::format("{:.3f} % off the reference", percent);
        if (options.mode != Mode::exact) return;
        // In exact mode all backends must produce the same bits as the first one.
        const auto [first, is_first] = exact_.try_emplace({row.fractal, options.precision}, image);
        const bool same = compare(first->second, image).same();
        row.ok = row.ok && same;
        row.said += is_first ? "" : same ? ", same bits" : ", OTHER BITS";
    }

    int side_;
    DemoFolder folder_;
    std::vector<DemoRow> rows_;
    std::map<std::pair<std::string, Mode>, std::pair<Image, double>> reference_;
    std::map<std::pair<std::string, Precision>, Image> exact_;
};

void draw_all(Demo& demo, const Registry& registry, int side)
{
    for (const Fractal& fractal : fractals()) {
        const Scene scene = official_scene(fractal, side, side);
        if (!registry.with(Role::reference).draws(scene)) continue;
        for (const auto& backend : registry.backends()) {
            const Role role = backend->info().role;
            const Listing listing = listing_of(*backend);
            if (listing.devices.empty()) {
                demo.absent(*backend, scene, listing);
                continue;
            }
            for (const Mode mode : {Mode::exact, Mode::fast}) {
                for (const Precision precision : {Precision::f64, Precision::f32}) {
                    if (role == Role::reference && precision == Precision::f32) continue;
                    demo.row(*backend, scene, {.precision = precision, .mode = mode});
                    if (role == Role::host)
                        demo.row(*backend, scene, {.precision = precision, .mode = mode, .simd_width = 1});
                }
            }
        }
    }
}

int body(int argc, char** argv)
{
    CLI::App app("demo: renders official scenes on every backend, compares the pictures and prints the times.");
    app.set_version_flag("--version", version_line("demo"));
    int side = 540;
    std::string folder;
    app.add_option("--side", side, "side of the square pictures, in pixels")
        ->check(whole(16, 4096))
        ->capture_default_str();
    app.add_option("--folder", folder, "write the pictures and the table (demo.json) to this folder");
    app.footer("Exit codes: 0 success, 1 a picture or a device failed, 2 bad input.");
    if (const auto done = parse_arguments(app, "demo", argc, argv)) return *done;

    const Registry registry = program_backends(argc, argv);
    print("{}, {} threads\n", cpu_name(), usable_threads());
    print("{} x {} pixels; fastest of {} pictures; speed-up over {}, exact; {}-scalar: the kernel as scalar C++\n",
          side, side, repetitions, registry.with(Role::reference).name(), registry.with(Role::host).name());
    print("{:<11} {:<13} {:<9} {:<5} {:>9} {:>9}   {}\n", "fractal", "backend", "precision", "mode", "wall ms",
          "speed-up", "picture");
    Demo demo(side, folder);
    draw_all(demo, registry, side);
    return demo.finish() ? exit_success : exit_failure;
}

}  // namespace

int demo_main(int argc, char** argv) { return mandelmarch::run_program("demo", body, argc, argv); }
