// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fstream>

#include "bench/figures.h"
#include "bench/portability.h"
#include "bench/report.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

template <class Value>
Json or_null(const std::optional<Value>& value)
{
    return value ? Json(*value) : Json();
}

Json of(const std::optional<Interval>& interval) { return interval ? Json{interval->low, interval->high} : Json(); }

Json of(const Summary& s)
{
    return {{"count", s.count}, {"launches", s.launches}, {"median", s.median},        {"mad", s.mad},
            {"least", s.least}, {"most", s.most},         {"interval", of(s.interval)}};
}

Json of(const Setting& s)
{
    return {{"width", s.width},     {"height", s.height},   {"iterations", s.iterations},
            {"detail", s.detail},   {"power", s.power},     {"view", s.view},
            {"without", s.without}, {"threads", s.threads}, {"pack", s.pack},
            {"chunk", s.chunk},     {"band", s.band},       {"block", s.block},
            {"frames", s.frames}};
}

Json of(const Work& w) { return {{"steps", w.steps}, {"de_calls", w.de_calls}, {"iterations", w.iterations}}; }

Json of(const Operations& o)
{
    return {{"sums", o.sums}, {"products", o.products}, {"quotients", o.quotients}, {"roots", o.roots}};
}

Json of(const Proof& p)
{
    return {{"drawn", p.drawn},
            {"fine", p.passed},
            {"yardstick", p.yardstick},
            {"level", p.level},
            {"text", p.text},
            {"against", p.against},
            {"pixels", p.pixels},
            {"differing", p.differing},
            {"visibly_differing", p.visibly_differing},
            {"largest_ulps", std::isfinite(p.largest_ulps) ? Json(p.largest_ulps) : Json()},
            {"psnr_db", std::isfinite(p.psnr) ? Json(p.psnr) : Json()}};
}

Json of(const Figures& f)
{
    return {{"kernel_seconds", of(f.kernel)},
            {"wall_seconds", of(f.wall)},
            {"upload_seconds", f.upload},
            {"readback_seconds", f.readback},
            {"host_seconds", f.host},
            {"unaccounted_share", or_null(f.unaccounted)},
            {"pixels_per_second", f.pixel_rate},
            {"de_calls_per_second", f.estimate_rate},
            {"iterations_per_second", f.iteration_rate},
            {"operations_per_second", or_null(f.operation_rate)},
            {"peak_operations_per_second", or_null(f.peak)},
            {"share_of_peak", or_null(f.share)},
            {"share_of_peak_standard_error", or_null(f.share_error)},
            {"bound_seconds", or_null(f.bound)},
            {"speed_up", f.speed_up ? Json(f.speed_up->ratio) : Json()},
            {"speed_up_interval", f.speed_up ? of(f.speed_up->interval) : Json()},
            {"over_scalar", f.over_scalar ? Json(f.over_scalar->ratio) : Json()},
            {"over_scalar_interval", f.over_scalar ? of(f.over_scalar->interval) : Json()}};
}

Json of(const Result& result, const Row& row)
{
    Json samples = Json::array();
    for (const Sample& s : row.samples) {
        samples.push_back({{"launch", s.launch},
                           {"round", s.round},
                           {"kernel", s.kernel},
                           {"wall", s.wall},
                           {"upload", s.upload},
                           {"readback", s.readback},
                           {"host", s.host}});
    }
    return {{"name", row.name()},
            {"fractal", row.fractal},
            {"precision", name_of(row.precision)},
            {"mode", name_of(row.mode)},
            {"backend", row.backend},
            {"application", application_of(result, row)},
            {"device", row.device},
            {"point", row.point},
            {"setting", of(row.setting)},
            {"unavailable", row.unavailable.empty() ? Json() : Json(row.unavailable)},
            {"failure", row.failure.empty() ? Json() : Json(row.failure)},
            {"platform", row.platform},
            {"device_name", row.device_name},
            {"vendor", row.vendor},
            {"driver", row.driver},
            {"is_gpu", row.is_gpu},
            {"instruction_set", row.instruction_set},
            {"threads", row.threads},
            {"pack", row.pack},
            {"proof", of(row.proof)},
            {"context_seconds", row.context},
            {"build_seconds", row.build},
            {"stride", row.step_factor > 0 ? Json(row.step_factor) : Json()},
            {"unsettled", row.unsettled},
            {"work", of(row.work)},
            {"operations", row.operations},
            {"operations_standard_error", or_null(row.operations_error)},
            {"samples", samples},
            {"figures", row.timed() ? of(figures_of(result, row)) : Json()}};
}

Json of(const LaneUse& use)
{
    Json json{{"lanes", use.lanes},
              {"active_in_steps", use.together.in_steps},
              {"active_in_iterations", use.together.in_iterations},
              {"refilled_active_in_steps", use.refilled->in_steps},
              {"refilled_active_in_iterations", use.refilled->in_iterations}};
    if (use.together_error && use.refilled_error) {
        json["standard_errors"] = {{"active_in_steps", use.together_error->in_steps},
                                   {"active_in_iterations", use.together_error->in_iterations},
                                   {"refilled_active_in_steps", use.refilled_error->in_steps},
                                   {"refilled_active_in_iterations", use.refilled_error->in_iterations}};
    }
    return json;
}

Json of(const Counted& c)
{
    Json stages = Json::object();
    for (int i = 0; i < stage_count; ++i) {
        stages[std::string(name_of(static_cast<Stage>(i)))] = of(c.count.stages.at(static_cast<std::size_t>(i)));
    }
    Json json{{"fractal", c.fractal},
              {"precision", name_of(c.precision)},
              {"mode", name_of(c.mode)},
              {"setting", of(c.setting)},
              {"pixels", c.count.pixels},
              {"hits", c.count.hits},
              {"work", of(c.count.work)},
              {"stages", stages},
              {"operations_per_iteration", c.count.per_iteration()},
              {"march_de_calls", c.count.march_estimates},
              {"march_iterations", c.count.march_iterations},
              {"lanes", c.count.lane_use.front().lanes},
              {"active_in_steps", c.count.lane_use.front().together.in_steps},
              {"active_in_iterations", c.count.lane_use.front().together.in_iterations}};
    if (const auto& errors = c.count.errors) {
        json["standard_errors"] = {{"operations_per_iteration", errors->per_iteration},
                                   {"march_iterations_per_de_call", errors->per_estimate}};
    }
    for (const LaneUse& use : c.count.lane_use) {
        if (use.refilled) json["lane_use"].push_back(of(use));
    }
    return json;
}

Json of(const std::vector<Ratio>& ratios)
{
    Json list = Json::array();
    for (const Ratio& ratio : ratios) {
        list.push_back({{"numerator", ratio.numerator->name()},
                        {"denominator", ratio.denominator->name()},
                        {"ratio", of(ratio.summary)}});
    }
    return list;
}

}  // namespace

Json json_of(const Result& result)
{
    Json json{{"schema", "mandelmarch-bench"}, {"version", schema_version},   {"study", result.study},
              {"seed", result.seed},           {"launches", result.launches}, {"environment", result.environment},
              {"warnings", result.warnings}};
    json["peaks"] = Json::array();
    for (const Peak& p : result.peaks) {
        json["peaks"].push_back({{"platform", p.platform},
                                 {"backend", p.backend},
                                 {"device", p.device},
                                 {"precision", name_of(p.precision)},
                                 {"operations_per_second", p.rate}});
    }
    json["counts"] = Json::array();
    for (const Counted& counted : result.counts) json["counts"].push_back(of(counted));
    json["stages"] = Json::array();
    for (const StageTime& s : result.stages) {
        json["stages"].push_back({{"fractal", s.fractal},
                                  {"precision", name_of(s.precision)},
                                  {"mode", name_of(s.mode)},
                                  {"stage", s.stage},
                                  {"seconds", s.seconds}});
    }
    json["rows"] = Json::array();
    for (const Row& row : result.rows) json["rows"].push_back(of(result, row));
    json["questions"] = {{fmt::format("{}_to_{}", box, bulb), of(box_to_bulb(result))},
                         {"double_to_float", of(double_to_float(result))},
                         {"others_to_host", of(others_to_host(result))},
                         {"to_first_point", of(to_first_point(result))},
                         {"to_previous_point", of(to_previous_point(result))}};
    json["portability"] = json_of(portability({&result, 1}));
    return json;
}

std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace mandelmarch::bench
