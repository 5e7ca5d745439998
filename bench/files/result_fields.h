// SPDX-License-Identifier: Apache-2.0
// The fields of a result file (docs/bench-output.md). To add a figure, add a line here.
#pragma once

#include <string>

#include "bench/files/fields.h"
#include "bench/files/rules.h"
#include "bench/judge/portability.h"
#include "bench/judge/winners.h"
#include "bench/result/result.h"

namespace mandelmarch::bench {

template <>
struct Fields<Summary> {
    static constexpr const char* name = "summary";
    static constexpr std::tuple list{
        field("count", &Summary::count),
        field(
            "runs", &Summary::runs, "",
            {.about = "Runs that the values come from. The interval of several runs is computed from their medians."}),
        field("median", &Summary::median, "s", rules::infinite),
        field("interval", &Summary::interval, "",
              {.about = "95 %. null: fewer than six samples of one run, or a time that is not above 0."}),
        field("mad", &Summary::mad, "mad_s",
              rules::about(rules::infinite, "Median absolute deviation from the median.")),
        field("min", &Summary::min, "", rules::infinite),
        field("max", &Summary::max, "", rules::infinite)};
};

template <>
struct Fields<Work> {
    static constexpr const char* name = "work";
    static constexpr std::tuple list{field("steps", &Work::steps, "steps", rules::count),
                                     field("de_calls", &Work::de_calls, "de_calls", rules::count),
                                     field("iterations", &Work::iterations, "iterations", rules::count)};
};

template <>
struct Fields<Operations> {
    static constexpr const char* name = "operations";
    static constexpr std::tuple list{
        field("additions", &Operations::additions), field("multiplications", &Operations::multiplications),
        field("divisions", &Operations::divisions), field("square_roots", &Operations::square_roots)};
};

template <>
struct Keys<std::array<Operations, stage_count>> {
    static constexpr auto list = stage_names;
};

template <>
struct Fields<Setting> {
    static constexpr const char* name = "setting";
    static constexpr std::tuple list{
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
        field("frames", &Setting::frames, "frames", {.about = "0: one picture from a warm renderer."})};
};

template <>
struct Fields<Verification> {
    static constexpr const char* name = "verification";
    static constexpr std::tuple list{field("drawn", &Verification::drawn),
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
};

template <>
struct Fields<Sample> {
    static constexpr const char* name = "sample";
    static constexpr std::tuple list{field("run", &Sample::run),
                                     field("round", &Sample::round, "", {.about = "Index in the run."}),
                                     field("kernel", &Sample::kernel, "", rules::seconds),
                                     field("wall", &Sample::wall, "", rules::seconds),
                                     field("upload", &Sample::upload, "", rules::seconds),
                                     field("readback", &Sample::readback, "", rules::seconds),
                                     field("host", &Sample::host, "", rules::seconds)};
};

template <>
struct Fields<Figures> {
    static constexpr const char* name = "figures";
    static constexpr std::tuple list{
        field("kernel_seconds", &Figures::kernel, "kernel"),
        field("wall_seconds", &Figures::wall, "wall"),
        field("upload_seconds", &Figures::upload, "upload_s"),
        field("host_seconds", &Figures::host, "host_s"),
        field("readback_seconds", &Figures::readback, "readback_s"),
        field("unaccounted_share", &Figures::unaccounted, "",
              {.min = -1e30,
               .max = 1,
               .about =
                   "Fraction of the wall time that upload, host and readback leave unaccounted for. null if a sample "
                   "is several pictures from a fresh renderer, as its wall time has further parts."}),
        field("pixels_per_second", &Figures::pixel_rate, "pixels_per_s"),
        field("de_calls_per_second", &Figures::estimate_rate, "de_calls_per_s"),
        field("iterations_per_second", &Figures::iteration_rate, "iterations_per_s"),
        field("operations_per_second", &Figures::operation_rate, "operations_per_s"),
        field("peak_operations_per_second", &Figures::peak, "peak_operations_per_s"),
        field("share_of_peak", &Figures::share, "share_of_peak"),
        field("share_of_peak_standard_error", &Figures::share_error, "share_of_peak_standard_error",
              {.about = "The part that comes from counting operations on a sample of the pixels only."}),
        field("bound_seconds", &Figures::bound, "bound_s"),
        field("speed_up", &Figures::speed_up, "speed_up"),
        field("over_scalar", &Figures::over_scalar, "over_scalar",
              {.about = "Wall time of the scalar kernel on the host's threads / this wall time; null if the scalar "
                        "kernel was not timed, and in its own row."})};
};

template <>
struct Fields<Row> {
    static constexpr const char* name = "row";
    static constexpr std::tuple list{
        derived_field("name", &Row::name, "name"),
        field("fractal", &Row::fractal, "fractal"),
        field("precision", &Row::precision, "precision"),
        field("mode", &Row::mode, "mode"),
        field("backend", &Row::backend),
        derived_field(
            "application", &Row::application, "backend",
            {.about = "Name under which rows are compared: the backend, or BACKEND-scalar for the scalar kernel in "
                      "the studies standard and demo."}),
        field("device", &Row::device, "device"),
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
        field(
            "unsettled", &Row::unsettled, "",
            {.max = 1,
             .about = "Fraction of the trial render's pixels that shorter steps would still change visibly; 0 if they "
                      "are few."}),
        field("work", &Row::work),
        field("operations", &Row::operations, "operations", rules::rate),
        field("operations_standard_error", &Row::operations_error, "operations_standard_error",
              rules::about(rules::rate, "0 if all pixels were counted; null in results of older builds.")),
        field("samples", &Row::samples, "samples"),
        derived_field("figures", &Row::figures)};
};

template <>
struct Fields<Peak> {
    static constexpr const char* name = "peak";
    static constexpr std::tuple list{field("platform", &Peak::platform), field("backend", &Peak::backend),
                                     field("device", &Peak::device), field("precision", &Peak::precision),
                                     field("operations_per_second", &Peak::rate, "", rules::rate)};
};

template <>
struct Fields<ActiveLanes> {
    static constexpr const char* name = "active_lanes";
    static constexpr std::tuple list{field("in_steps", &ActiveLanes::in_steps, "", rules::fraction),
                                     field("in_iterations", &ActiveLanes::in_iterations, "", rules::fraction)};
};

template <>
struct Fields<LaneUse> {
    static constexpr const char* name = "lane_use";
    static constexpr std::tuple list{
        field("lanes", &LaneUse::lanes), field("together", &LaneUse::together),
        field("refilled", &LaneUse::refilled, "", {.about = "null in results of older builds."}),
        field("together_standard_error", &LaneUse::together_error, "", {.about = "null in results of older builds."}),
        field("refilled_standard_error", &LaneUse::refilled_error, "", {.about = "null in results of older builds."})};
};

template <>
struct Fields<CountErrors> {
    static constexpr const char* name = "count_errors";
    static constexpr std::tuple list{
        field("operations_per_iteration", &CountErrors::per_iteration, "", rules::rate),
        field("march_iterations_per_de_call", &CountErrors::per_estimate, "", rules::rate)};
};

template <>
struct Fields<Count> {
    static constexpr const char* name = "count";
    static constexpr std::tuple list{
        field("pixels", &Count::pixels),
        field("hits", &Count::hits),
        field("work", &Count::work),
        field("stages", &Count::stages),
        derived_field("operations_per_iteration", &Count::per_iteration),
        field("march_de_calls", &Count::march_estimates),
        field("march_iterations", &Count::march_iterations),
        field("lane_use", &Count::lane_use),
        field("standard_errors", &Count::errors, "",
              {.about = "Of quantities that come from a sample of the pixels; 0 if all pixels were counted. null in "
                        "results of older builds."})};
};

template <>
struct Fields<Counted> {
    static constexpr const char* name = "counted";
    static constexpr auto list =
        std::tuple_cat(std::tuple{field("fractal", &Counted::fractal), field("precision", &Counted::precision),
                                  field("mode", &Counted::mode), field("setting", &Counted::setting)},
                       Fields<Count>::list);
};

template <>
struct Fields<StageTime> {
    static constexpr const char* name = "stage_time";
    static constexpr std::tuple list{field("fractal", &StageTime::fractal), field("precision", &StageTime::precision),
                                     field("mode", &StageTime::mode), field("stage", &StageTime::stage),
                                     field("seconds", &StageTime::seconds, "", rules::seconds)};
};

template <>
struct Fields<Ratio> {
    static constexpr const char* name = "ratio";
    static constexpr std::tuple list{field("numerator", &Ratio::numerator), field("denominator", &Ratio::denominator),
                                     field("ratio", &Ratio::ratio)};
};

template <>
struct Fields<Questions> {
    static constexpr const char* name = "questions";
    static constexpr std::tuple list{
        field("mandelbox_to_mandelbulb", &Questions::box_to_bulb),
        field("double_to_float", &Questions::double_to_float), field("others_to_host", &Questions::others_to_host),
        field("to_first_value", &Questions::to_first_value, "", {.about = "Only in sweeps."}),
        field("to_previous_value", &Questions::to_previous_value, "",
              {.about = "Only in sweeps, for pictures with the same aspect ratio."})};
};

template <>
struct Fields<OnPlatform> {
    static constexpr const char* name = "on_platform";
    static constexpr std::tuple list{
        field("platform", &OnPlatform::platform),
        field("kernel_seconds", &OnPlatform::seconds, "", {.null = Null::zero, .about = "null: not supported."}),
        field("application_efficiency", &OnPlatform::application), field("share_of_peak", &OnPlatform::architecture)};
};

template <>
struct Fields<CascadeStep> {
    static constexpr const char* name = "cascade_step";
    static constexpr std::tuple list{field("platform", &CascadeStep::platform),
                                     field("efficiency", &CascadeStep::efficiency),
                                     field("portability", &CascadeStep::portability)};
};

template <>
struct Fields<Portability> {
    static constexpr const char* name = "portability";
    static constexpr std::tuple list{
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
};

template <>
struct Fields<Judged> {
    template <class Value>
    static std::optional<Value> if_tested(const Judged& row, const Value& value)
    {
        return row.why.empty() ? std::optional(value) : std::nullopt;
    }

    static constexpr const char* name = "verdict";
    static constexpr std::tuple list{
        field("name", &Judged::name, "", {.about = "Name of a row, or `all rows` for the geometric mean of the rows."}),
        field("verdict", &Judged::verdict),
        field("why", &Judged::why, "", {.null = Null::empty, .about = "Why the ratio was not tested; null if it was."}),
        derived_field("ratio", [](const Judged& row) { return if_tested(row, row.difference.ratio); }, "",
                      {.about = "Ratio of times, new / old."}),
        derived_field("interval", [](const Judged& row) { return if_tested(row, row.difference.interval); }, "",
                      {.about = "95 % interval of the ratio."}),
        derived_field("p", [](const Judged& row) { return if_tested(row, row.p); }, "",
                      {.about = "After Holm's correction."}),
        field("runs", &Judged::new_units)};
};

template <>
struct Fields<Contest> {
    static constexpr const char* name = "contest";
    static constexpr std::tuple list{
        derived_field("fastest", [](const Contest& contest) { return contest.fastest->name(); }, "",
                      {.about = "Name of the row with the shortest kernel time in its fractal, precision and mode."}),
        field("rivals", &Contest::rivals, "",
              {.about = "The other applications' rows, fastest first. ratio: their kernel time / the fastest's."})};
};

template <>
struct Fields<Result> {
    static constexpr const char* name = "result";
    static constexpr std::tuple list{
        field("study", &Result::study),
        field("seed", &Result::seed),
        field("runs", &Result::runs, "", {.about = "Number of runs (processes) that left samples."}),
        field("environment", &Result::environment),
        field("warnings", &Result::warnings),
        field("peaks", &Result::peaks),
        field("counts", &Result::counts),
        field("stages", &Result::stages),
        field("rows", &Result::rows),
        derived_field("questions", &Result::questions)};
};

}  // namespace mandelmarch::bench
