// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "bench/figures.h"
#include "bench/report.h"

namespace mandelmarch::bench {
namespace {

std::string or_empty(const std::optional<double>& value) { return value ? fmt::format("{}", *value) : std::string(); }

// Returns the ratio and both ends of its interval.
std::array<std::string, 3> three_cells(const std::optional<Quotient>& quotient)
{
    if (!quotient) return {};
    const auto& interval = quotient->interval;
    return {fmt::format("{}", quotient->ratio), interval ? fmt::format("{}", interval->low) : "",
            interval ? fmt::format("{}", interval->high) : ""};
}

}  // namespace

std::string problem_name(const std::string& fractal, Precision precision, Mode mode, int width, int height)
{
    return fmt::format("{} {} {} {}x{}", fractal, name_of(precision), name_of(mode), width, height);
}

std::string csv_cell(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string made = "\"";
    for (const char c : text) {
        if (c == '"') made += '"';
        made += c;
    }
    return made + "\"";
}

std::string to_csv(const Result& result)
{
    std::string text =
        "problem,application,platform,fom,name,fractal,precision,mode,backend,device,point,width,height,iterations_"
        "limit,"
        "detail,threads,pack,frames,proof,proof_fine,differing_pixels,samples,kernel_s,kernel_low_s,kernel_high_s,"
        "kernel_mad_s,wall_s,context_s,build_s,upload_s,host_s,readback_s,pixels_per_s,de_calls_per_s,iterations_per_s,"
        "operations,operations_standard_error,operations_per_s,peak_operations_per_s,share_of_peak,share_of_peak_"
        "standard_"
        "error,bound_s,speed_up,speed_up_low,speed_up_high,"
        "over_scalar,over_scalar_low,over_scalar_high,"
        "steps,de_calls,iterations,"
        "unavailable,failure\n";
    for (const Row& row : result.rows) {
        const Setting& s = row.setting;
        const std::string application = application_of(result, row);
        // In a sweep each sweep value is a separate problem. The scalar kernel also has a sweep value, but is another
        // application of the same problem.
        const bool one_problem = row.point.empty() || application != row.backend;
        const std::string problem = problem_name(row.fractal, row.precision, row.mode, s.width, s.height) +
                                    (one_problem ? "" : " " + row.point);
        const Figures f = row.timed() ? figures_of(result, row) : Figures{};
        const auto timed = [&](double value) { return row.timed() ? fmt::format("{}", value) : std::string(); };
        const auto& interval = f.kernel.interval;
        const auto up = three_cells(f.speed_up);
        const auto scalar = three_cells(f.over_scalar);
        const std::vector<std::string> cells{csv_cell(problem),
                                             application,
                                             csv_cell(row.platform),
                                             timed(f.pixel_rate),
                                             csv_cell(row.name()),
                                             row.fractal,
                                             std::string(name_of(row.precision)),
                                             std::string(name_of(row.mode)),
                                             application,
                                             fmt::format("{}", row.device),
                                             csv_cell(row.point),
                                             fmt::format("{}", s.width),
                                             fmt::format("{}", s.height),
                                             fmt::format("{}", s.iterations),
                                             fmt::format("{}", s.detail),
                                             fmt::format("{}", row.threads),
                                             fmt::format("{}", row.pack),
                                             fmt::format("{}", s.frames),
                                             csv_cell(row.proof.text),
                                             row.proof.drawn ? (row.proof.passed ? "1" : "0") : "",
                                             row.proof.drawn ? fmt::format("{}", row.proof.differing) : "",
                                             fmt::format("{}", row.samples.size()),
                                             timed(f.kernel.median),
                                             interval ? fmt::format("{}", interval->low) : "",
                                             interval ? fmt::format("{}", interval->high) : "",
                                             timed(f.kernel.mad),
                                             timed(f.wall.median),
                                             timed(row.context),
                                             timed(row.build),
                                             timed(f.upload),
                                             timed(f.host),
                                             timed(f.readback),
                                             timed(f.pixel_rate),
                                             timed(f.estimate_rate),
                                             timed(f.iteration_rate),
                                             timed(row.operations),
                                             row.timed() ? or_empty(row.operations_error) : "",
                                             or_empty(f.operation_rate),
                                             or_empty(f.peak),
                                             or_empty(f.share),
                                             or_empty(f.share_error),
                                             or_empty(f.bound),
                                             up[0],
                                             up[1],
                                             up[2],
                                             scalar[0],
                                             scalar[1],
                                             scalar[2],
                                             timed(static_cast<double>(row.work.steps)),
                                             timed(static_cast<double>(row.work.de_calls)),
                                             timed(static_cast<double>(row.work.iterations)),
                                             csv_cell(row.unavailable),
                                             csv_cell(row.failure)};
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

}  // namespace mandelmarch::bench
