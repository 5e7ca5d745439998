// SPDX-License-Identifier: Apache-2.0
// demo: the study `demo` of bench as a program of its own, which builds faster than bench. Renders the official scenes
// on every backend in both precisions and both modes, verifies the pictures, times them and prints a table. The exit
// code is 1 if a picture is wrong or a device fails.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/cli/options.h"
#include "backends/all.h"
#include "bench/command/display.h"
#include "bench/measure/verify.h"
#include "bench/print/printers.h"
#include "bench/result/figures.h"
#include "core/image/formats/image_file.h"
#include "core/os/cores.h"
#include "core/os/cpu.h"
#include "core/os/output_file.h"
#include "core/os/program.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/version.h"

namespace {

using namespace mandelmarch;
using namespace mandelmarch::bench;

// The output folder: pictures as PNG files, and the table as demo.json. The report makes a page from these files.
class Folder {
public:
    // Creates the folder if it does not exist. If `path` is empty, nothing is written. Throws Error if the folder
    // cannot be created.
    explicit Folder(std::string path) : path_(std::move(path))
    {
        if (path_.empty()) return;
        std::error_code failure;
        std::filesystem::create_directories(path_, failure);
        if (failure) throw Error(fmt::format("{}: {}", path_, failure.message()));
    }

    void write_picture(const Row& row, const Image& image)
    {
        if (path_.empty()) return;
        const std::string file =
            fmt::format("{}-{}{}-{}-{}.png", row.fractal, row.backend, row.setting.simd_width == 1 ? "-1" : "",
                        name_of(row.precision), name_of(row.mode));
        try {
            write_image(fmt::format("{}/{}", path_, file), ImageFormat::png, image, NamedBy::program);
            pictures_[row.name()] = file;
        } catch (const Error& error) {
            fault_ = error.what();
        }
    }

    // Throws Error if a picture could not be written, with the last picture's message.
    void check() const
    {
        if (!fault_.empty()) throw Error(fault_);
    }

    void write_table(const Result& result, int side) const
    {
        if (path_.empty()) return;
        nlohmann::ordered_json json{
            {"schema", 1},
            {"version", project_version()},
            {"revision", source_revision()},
            {"cpu", cpu_name()},
            {"threads", usable_threads()},
            {"side", side},
            {"repetitions", study_named(demo_study).most_rounds},
        };
        for (const Fractal* fractal : default_fractals()) {
            for (const Row& row : result.rows) {
                // A backend without a device has one row, which stands for all fractals.
                if (row.fractal == fractal->name || row.fractal == "all") json["rows"].push_back(entry(row, *fractal));
            }
        }
        // A driver's name is not always valid UTF-8.
        write_file(path_ + "/demo.json", json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n",
                   NamedBy::program);
    }

private:
    nlohmann::ordered_json entry(const Row& row, const Fractal& fractal) const
    {
        const auto picture = pictures_.find(row.name());
        const std::string why = row.unavailable + row.failure;
        return {{"fractal", fractal.name},
                {"backend", row.backend},
                {"simd_width", row.setting.simd_width},
                {"precision", name_of(row.precision)},
                {"mode", name_of(row.mode)},
                {"drawn", picture != pictures_.end()},
                {"fine", !row.failed()},
                {"said", why.empty() ? row.verification.text : why},
                {"device", row.device_name},
                {"is_gpu", row.is_gpu},
                {"wall_seconds", row.figures ? row.figures->wall.median : 0},
                {"speed_up", row.figures && row.figures->speed_up ? row.figures->speed_up->ratio : 0},
                {"picture", picture != pictures_.end() ? picture->second : ""}};
    }

    std::string path_;
    std::map<std::string, std::string> pictures_;  // file names, by the names of configurations
    std::string fault_;                            // empty: every picture was written
};

int body(int argc, char** argv)
{
    CLI::App app("demo: renders official scenes on every backend, compares the pictures and prints the times.");
    app.set_version_flag("--version", version_line("demo"));
    int side = 540;
    std::string path;
    app.add_option("--side", side, "side of the square pictures, in pixels")
        ->check(whole(16, 4096))
        ->capture_default_str();
    app.add_option("--folder", path, "write the pictures and the table (demo.json) to this folder");
    app.footer("Exit codes: 0 success, 1 a wrong picture or a device that failed, 2 bad input." +
               environment_help("demo"));
    if (const auto done = parse_arguments(app, "demo", argc, argv)) return *done;

    const Registry registry = program_backends(argc, argv);
    Options options;
    options.study = &study_named(demo_study);
    options.budget = 75;
    options.size = std::pair(side, side);
    Folder folder(path);
    Display display("demo");
    const Phase phase = [&](const Step& step) { display.show(step); };
    std::vector<Case> cases = cases_of(registry, options);
    std::vector<TimedCase> live = verified_cases(
        cases, registry, phase, [&](const Row& row, const Image& image) { folder.write_picture(row, image); });
    keep_long_pictures(live, options);
    run_rounds(live, options, phase);
    display.finish();
    Result result;
    result.study = demo_study;
    for (const auto& backend : registry.backends()) {
        result.environment["backends"].push_back({{"name", backend->name()}, {"role", name_of(backend->info().role)}});
    }
    for (Case& one : cases) result.rows.push_back(std::move(one.row));
    result = derived(std::move(result));
    print(
        "{}, {} threads\n{} x {} pixels; kernel and wall: medians in ms; speed-up: of wall time over {}, double, "
        "exact\n{}",
        cpu_name(), usable_threads(), side, side, result.reference(), main_table(result));
    folder.write_table(result, side);
    folder.check();
    return result.failed() ? exit_failure : exit_success;
}

}  // namespace

int demo_main(int argc, char** argv) { return run_program("demo", body, argc, argv); }
