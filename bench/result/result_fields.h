// SPDX-License-Identifier: Apache-2.0
// The fields of a result (docs/bench-output.md). To add a column, add a member to the record and a line here.
#pragma once

#include <string>

#include "bench/result/document.h"
#include "bench/result/fields.h"
#include "bench/result/portability.h"
#include "bench/result/result.h"
#include "bench/result/rules.h"
#include "bench/result/winners.h"

namespace mandelmarch::bench {

template <>
inline constexpr auto fields_of<Summary> = Description{
    "summary",
    field("count", &Summary::count),
    field("runs", &Summary::runs, "",
          {.about = "Runs that the values come from. The interval of several runs is computed from their medians."}),
    field("median", &Summary::median, "s", rules::infinite),
    field("interval", &Summary::interval, "",
          {.about = "95 %. null: fewer than six samples of one run, or a time that is not above 0."}),
    field("mad", &Summary::mad, "mad_s", rules::about(rules::infinite, "Median absolute deviation from the median.")),
    field("min", &Summary::min, "", rules::infinite),
    field("max", &Summary::max, "", rules::infinite)};

template <>
inline constexpr auto fields_of<Work> = Description{"work", field("steps", &Work::steps, "steps", rules::count),
                                                    field("de_calls", &Work::de_calls, "de_calls", rules::count),
                                                    field("iterations", &Work::iterations, "iterations", rules::count)};

template <>
inline constexpr auto fields_of<Operations> = Description{
    "operations", field("additions", &Operations::additions), field("multiplications", &Operations::multiplications),
    field("divisions", &Operations::divisions), field("square_roots", &Operations::square_roots)};

template <>
inline constexpr auto keys_of<std::array<Operations, stage_count>> = stage_names;

template <>
inline constexpr auto fields_of<Setting> =
    Description{"setting",
                field("width", &Setting::width, "width", {.max = max_side}),
                field("height", &Setting::height, "height", {.max = max_side}),
                field("iterations", &Setting::iterations, "iterations_limit"),
                field("detail", &Setting::detail, "detail", rules::real),
                field("power", &Setting::power, "", rules::real),
                field("view", &Setting::view),
                field("without", &Setting::without, "", {.about = "Disabled optimisations, separated by commas."}),
                field("threads", &Setting::threads, "", {.about = "0: chosen by the backend."}),
                field("simd_width", &Setting::simd_width, "", {.about = "0: chosen by the backend."}),
                field("chunk", &Setting::chunk, "", {.about = "0: chosen by the backend."}),
                field("band", &Setting::band, "", {.about = "0: chosen by the backend."}),
                field("block_size", &Setting::block_size, "", {.about = "0: chosen by the backend."}),
                field("resident_warps", &Setting::resident_warps, "", {.about = "0: chosen by the backend."}),
                field("frames", &Setting::frames, "frames", {.about = "0: one picture from a warm renderer."})};

template <>
inline constexpr auto fields_of<Verification> =
    Description{"verification",
                field("drawn", &Verification::drawn),
                field("passed", &Verification::passed, "verified"),
                field("is_expected", &Verification::is_expected, "",
                      {.about = "The configuration renders the expected picture itself."}),
                field("level", &Verification::level),
                field("text", &Verification::text, "verification"),
                field("against", &Verification::against),
                field("pixels", &Verification::pixels),
                field("differing", &Verification::differing, "differing_pixels"),
                field("visibly_differing", &Verification::visibly_differing),
                field("max_ulps", &Verification::max_ulps, "", rules::infinite),
                field("psnr_db", &Verification::psnr, "", rules::infinite)};

template <>
inline constexpr auto fields_of<Sample> =
    Description{"sample",
                field("run", &Sample::run, "", rules::required),
                field("round", &Sample::round, "", {.required = true, .about = "Index in the run."}),
                field("kernel", &Sample::kernel, "", rules::required_seconds),
                field("wall", &Sample::wall, "", rules::required_seconds),
                field("upload", &Sample::upload, "", rules::seconds),
                field("readback", &Sample::readback, "", rules::seconds),
                field("host", &Sample::host, "", rules::seconds),
                field("trial", &Sample::trial, "", rules::seconds),
                field("joules", &Sample::joules, "", rules::energy)};

template <>
inline constexpr auto fields_of<Figures> = Description{
    "figures",
    field("kernel_seconds", &Figures::kernel, "kernel"),
    field("wall_seconds", &Figures::wall, "wall"),
    field("upload_seconds", &Figures::upload, "upload_s"),
    field("host_seconds", &Figures::host, "host_s"),
    field("trial_seconds", &Figures::trial, "trial_s"),
    field("readback_seconds", &Figures::readback, "readback_s"),
    field("unaccounted_share", &Figures::unaccounted, "",
          {.min = -1e30,
           .max = 1,
           .about = "Fraction of the wall time that upload, host and readback leave unaccounted for. null if a sample "
                    "is several pictures from a fresh renderer, as its wall time has further parts."}),
    field("joules", &Figures::joules, "joules",
          {.about = "Energy of a picture: the machine's processors (RAPL) and NVIDIA GPUs (NVML)."}),
    field("pixels_per_second", &Figures::pixel_rate, "pixels_per_s"),
    field("de_calls_per_second", &Figures::estimate_rate, "de_calls_per_s"),
    field("iterations_per_second", &Figures::iteration_rate, "iterations_per_s"),
    field("operations_per_second", &Figures::operation_rate, "operations_per_s"),
    field("peak_operations_per_second", &Figures::peak, "peak_operations_per_s"),
    field("share_of_peak", &Figures::share, "share_of_peak"),
    field("bound_seconds", &Figures::bound, "bound_s"),
    field("speed_up", &Figures::speed_up, "speed_up"),
    field("over_scalar", &Figures::over_scalar, "over_scalar",
          {.about = "Wall time of the scalar kernel on the host's threads / this wall time; null if the scalar "
                    "kernel was not timed, and in its own row."})};

template <>
inline constexpr auto fields_of<Row> = Description{
    "row",
    derived_field("name", &Row::name, "name"),
    field("fractal", &Row::fractal, "fractal", rules::required),
    field("precision", &Row::precision, "precision", rules::required),
    field("mode", &Row::mode, "mode", rules::required),
    field("backend", &Row::backend, "", rules::required),
    derived_field(
        "application", &Row::application, "backend",
        {.about = "Name under which rows are compared: the backend, or BACKEND-scalar for the scalar kernel in "
                  "the studies standard and demo."}),
    field("device", &Row::device, "device", rules::required),
    field("sweep_value", &Row::sweep_value, "sweep_value", {.about = "NAME=VALUE in a sweep, else empty."}),
    field("setting", &Row::setting),
    field("unavailable", &Row::unavailable, "unavailable", rules::text_or_null),
    field("failure", &Row::failure, "failure", rules::text_or_null),
    field("platform", &Row::platform),
    field("device_name", &Row::device_name),
    field("vendor", &Row::vendor),
    field("driver", &Row::driver),
    field("is_gpu", &Row::is_gpu),
    field("instruction_set", &Row::instruction_set),
    field("threads", &Row::threads, "threads"),
    field("simd_width", &Row::simd_width, "simd_width"),
    field("verification", &Row::verification),
    field("context_seconds", &Row::context, "context_s", rules::seconds),
    field("build_seconds", &Row::build, "build_s", rules::seconds),
    field("step_factor", &Row::step_factor, "",
          {.max = 1,
           .null = Null::zero,
           .about = "Length of fast mode's plain steps, in distance estimates, chosen by a trial render; null if "
                    "there was none."}),
    field("unsettled", &Row::unsettled, "",
          {.max = 1,
           .about = "Fraction of the trial render's pixels that shorter steps would still change visibly; 0 if they "
                    "are few."}),
    field("work", &Row::work),
    field("operations", &Row::operations, "operations", rules::rate),
    field("samples", &Row::samples, "samples", rules::required),
    derived_field("figures", &Row::figures)};

template <>
inline constexpr auto fields_of<Peak> = Description{"peak",
                                                    field("platform", &Peak::platform, "", rules::required),
                                                    field("backend", &Peak::backend),
                                                    field("device", &Peak::device),
                                                    field("precision", &Peak::precision, "", rules::required),
                                                    field("operations_per_second", &Peak::rate, "", rules::rate)};

template <>
inline constexpr auto fields_of<ActiveLanes> =
    Description{"active_lanes", field("in_steps", &ActiveLanes::in_steps, "", rules::fraction),
                field("in_iterations", &ActiveLanes::in_iterations, "", rules::fraction)};

template <>
inline constexpr auto fields_of<LaneUse> =
    Description{"lane_use", field("lanes", &LaneUse::lanes), field("together", &LaneUse::together, "", rules::required),
                field("refilled", &LaneUse::refilled)};

template <>
inline constexpr auto fields_of<Counted> =
    Description{"counted",
                field("fractal", &Counted::fractal, "", rules::required),
                field("precision", &Counted::precision, "", rules::required),
                field("mode", &Counted::mode, "", rules::required),
                field("setting", &Counted::setting),
                field("pixels", &Counted::pixels),
                field("hits", &Counted::hits),
                field("work", &Counted::work),
                field("stages", &Counted::stages),
                derived_field("operations_per_iteration", &Counted::per_iteration),
                field("march_de_calls", &Counted::march_estimates),
                field("march_iterations", &Counted::march_iterations),
                field("lane_use", &Counted::lane_use)};

template <>
inline constexpr auto fields_of<Ratio> =
    Description{"ratio", field("numerator", &Ratio::numerator), field("denominator", &Ratio::denominator),
                field("ratio", &Ratio::ratio)};

template <>
inline constexpr auto fields_of<Questions> =
    Description{"questions",
                field("mandelbox_to_mandelbulb", &Questions::box_to_bulb),
                field("double_to_float", &Questions::double_to_float),
                field("others_to_host", &Questions::others_to_host),
                field("to_first_value", &Questions::to_first_value, "", {.about = "Only in sweeps."}),
                field("to_previous_value", &Questions::to_previous_value, "",
                      {.about = "Only in sweeps, for pictures with the same aspect ratio."})};

template <>
inline constexpr auto fields_of<OnPlatform> = Description{
    "on_platform", field("platform", &OnPlatform::platform),
    field("kernel_seconds", &OnPlatform::seconds, "", {.null = Null::zero, .about = "null: not supported."}),
    field("application_efficiency", &OnPlatform::application), field("share_of_peak", &OnPlatform::architecture)};

template <>
inline constexpr auto fields_of<CascadeStep> =
    Description{"cascade_step", field("platform", &CascadeStep::platform),
                field("efficiency", &CascadeStep::efficiency), field("portability", &CascadeStep::portability)};

template <>
inline constexpr auto fields_of<Portability> =
    Description{"portability",
                field("problem", &Portability::problem),
                field("fractal", &Portability::fractal),
                field("precision", &Portability::precision),
                field("mode", &Portability::mode),
                field("application", &Portability::application),
                field("by_application_efficiency", &Portability::application_portability),
                field("by_application_efficiency_interval", &Portability::application_interval),
                field("by_share_of_peak", &Portability::architecture_portability),
                field("by_share_of_peak_interval", &Portability::architecture_interval),
                field("platforms", &Portability::platforms),
                field("not_measured", &Portability::not_measured, "",
                      {.about = "Platforms that occur only in results without this application; they are not in H."}),
                field("cascade", &Portability::cascade)};

// Returns the value if the configuration's ratio was tested.
template <class Value>
std::optional<Value> if_tested(const Compared& row, const Value& value)
{
    return row.why.empty() ? std::optional(value) : std::nullopt;
}

template <>
inline constexpr auto fields_of<Compared> = Description{
    "verdict",
    field("name", &Compared::name, "", {.about = "Name of a row, or `all rows` for the geometric mean of the rows."}),
    field("verdict", &Compared::verdict),
    field("why", &Compared::why, "", {.null = Null::empty, .about = "Why the ratio was not tested; null if it was."}),
    derived_field("ratio", [](const Compared& row) { return if_tested(row, row.difference.ratio); }, "",
                  {.about = "Ratio of times, new / old."}),
    derived_field("interval", [](const Compared& row) { return if_tested(row, row.difference.interval); }, "",
                  {.about = "95 % interval of the ratio."}),
    derived_field("p", [](const Compared& row) { return if_tested(row, row.p); }, "",
                  {.about = "After Holm's correction."}),
    field("runs", &Compared::new_units)};

template <>
inline constexpr auto fields_of<Ranking> = Description{
    "ranking",
    derived_field("fastest", [](const Ranking& ranking) { return ranking.fastest->name(); }, "",
                  {.about = "Name of the row with the shortest kernel time in its fractal, precision and mode."}),
    field("others", &Ranking::others, "",
          {.about = "The other applications' rows, fastest first. ratio: their kernel time / the fastest's."})};

// Returns the portability of the applications that ran.
inline std::vector<Portability> portability_of(const Result& result)
{
    std::vector<Portability> all = portability({&result, 1});
    std::erase_if(all, [](const Portability& one) { return one.platforms.empty(); });
    return all;
}

template <>
inline constexpr auto fields_of<Result> =
    Description{"result",
                field("study", &Result::study, "", rules::required),
                field("seed", &Result::seed),
                field("runs", &Result::runs, "", {.about = "Number of runs (processes) that left samples."}),
                field("moved_eye", &Result::moved_eye, "", {.about = "Each round had other views (--move-eye)."}),
                field("environment", &Result::environment),
                field("warnings", &Result::warnings),
                field("peaks", &Result::peaks),
                field("counts", &Result::counts),
                field("rows", &Result::rows, "", rules::required),
                derived_field("questions", &Result::questions),
                derived_field("portability", portability_of),
                derived_field("winners", rankings_of, "", {.about = "Only in results of a standard study."})};

template <>
inline constexpr Format format_of<Result>{result_schema, 2};

}  // namespace mandelmarch::bench
