#include <fmt/format.h>

#include <fstream>
#include <limits>

#include "bench/report.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string text_or_nothing(const Json& json) { return json.is_null() ? std::string() : json.get<std::string>(); }

double number_or_infinity(const Json& json)
{
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Precision precision_of(const Json& json)
{
    return json.get<std::string>() == "float" ? Precision::f32 : Precision::f64;
}

Mode mode_of(const Json& json) { return json.get<std::string>() == "fast" ? Mode::fast : Mode::exact; }

Setting setting_of(const Json& json)
{
    Setting s;
    s.width = json.at("width");
    s.height = json.at("height");
    s.iterations = json.at("iterations");
    s.detail = json.at("detail");
    s.power = json.at("power");
    s.view = json.at("view");
    s.without = json.at("without");
    s.threads = json.at("threads");
    s.pack = json.at("pack");
    s.chunk = json.at("chunk");
    s.frames = json.at("frames");
    return s;
}

Work work_of(const Json& json) { return {json.at("steps"), json.at("de_calls"), json.at("iterations")}; }

Proof proof_of(const Json& json)
{
    Proof p;
    p.drawn = json.at("drawn");
    p.fine = json.at("fine");
    p.yardstick = json.at("yardstick");
    p.level = json.at("level");
    p.text = json.at("text");
    p.against = json.at("against");
    p.pixels = json.at("pixels");
    p.differing = json.at("differing");
    p.visibly_differing = json.at("visibly_differing");
    p.largest_ulps = number_or_infinity(json.at("largest_ulps"));
    p.psnr = number_or_infinity(json.at("psnr_db"));
    return p;
}

Row row_of(const Json& json)
{
    Row row;
    row.fractal = json.at("fractal");
    row.precision = precision_of(json.at("precision"));
    row.mode = mode_of(json.at("mode"));
    row.backend = json.at("backend");
    row.device = json.at("device");
    row.point = json.at("point");
    row.setting = setting_of(json.at("setting"));
    row.unavailable = text_or_nothing(json.at("unavailable"));
    row.failure = text_or_nothing(json.at("failure"));
    row.platform = json.at("platform");
    row.device_name = json.at("device_name");
    row.vendor = json.at("vendor");
    row.driver = json.at("driver");
    row.is_gpu = json.at("is_gpu");
    row.instruction_set = json.at("instruction_set");
    row.threads = json.at("threads");
    row.pack = json.at("pack");
    row.proof = proof_of(json.at("proof"));
    row.context = json.at("context_seconds");
    row.build = json.at("build_seconds");
    row.work = work_of(json.at("work"));
    row.operations = json.at("operations");
    for (const Json& sample : json.at("samples")) {
        row.samples.push_back({.launch = sample.at("launch"),
                               .round = sample.at("round"),
                               .kernel = sample.at("kernel"),
                               .wall = sample.at("wall"),
                               .upload = sample.at("upload"),
                               .readback = sample.at("readback")});
    }
    return row;
}

Counted counted_of(const Json& json)
{
    Counted c;
    c.fractal = json.at("fractal");
    c.precision = precision_of(json.at("precision"));
    c.mode = mode_of(json.at("mode"));
    c.setting = setting_of(json.at("setting"));
    for (int i = 0; i < stage_count; ++i) {
        const Json& o = json.at("stages").at(std::string(name_of(static_cast<Stage>(i))));
        c.count.stages.at(static_cast<std::size_t>(i)) = {o.at("sums"), o.at("products"), o.at("quotients"),
                                                          o.at("roots")};
    }
    c.count.pixels = json.at("pixels");
    c.count.hits = json.at("hits");
    c.count.work = work_of(json.at("work"));
    c.count.march_estimates = json.at("march_de_calls");
    c.count.march_iterations = json.at("march_iterations");
    c.count.lanes = json.at("lanes");
    c.count.active_in_steps = json.at("active_in_steps");
    c.count.active_in_iterations = json.at("active_in_iterations");
    return c;
}

}  // namespace

Result from_json(const Json& json, const std::string& name)
{
    try {
        if (json.at("schema") != "mandelmarch-bench") throw InputError(name + ": no result of bench");
        if (const int version = json.at("version"); version != schema_version) {
            throw InputError(
                fmt::format("{}: version {} of the result format, expected {}", name, version, schema_version));
        }
        Result result;
        result.study = json.at("study");
        result.seed = json.at("seed");
        result.launches = json.at("launches");
        result.environment = json.at("environment");
        result.warnings = json.at("warnings").get<std::vector<std::string>>();
        for (const Json& p : json.at("peaks")) {
            result.peaks.push_back({p.at("platform"), p.at("backend"), p.at("device"), precision_of(p.at("precision")),
                                    p.at("operations_per_second")});
        }
        for (const Json& counted : json.at("counts")) result.counts.push_back(counted_of(counted));
        for (const Json& s : json.at("stages")) {
            result.stages.push_back({s.at("fractal"), precision_of(s.at("precision")), mode_of(s.at("mode")),
                                     s.at("stage"), s.at("seconds").get<std::vector<double>>()});
        }
        for (const Json& row : json.at("rows")) result.rows.push_back(row_of(row));
        return result;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: no result of bench: {}", name, error.what()));
    }
}

Result read_result(const std::string& path)
{
    std::ifstream file(path);
    if (!file) throw InputError(path + ": cannot be read, expected a result file of bench --json");
    const Json json = Json::parse(file, nullptr, false);
    if (json.is_discarded()) throw InputError(path + ": no JSON, expected a result file of bench --json");
    return from_json(json, path);
}

}  // namespace mandelmarch::bench
