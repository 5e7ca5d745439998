// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <set>

#include "bench/report.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/image/image.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t most_counted = std::uint64_t{1} << 53;  // JSON's numbers are exact integers up to here
constexpr double most_seconds = 1e9;                            // about thirty years
constexpr double most_rate = 1e30;                              // operations per second

// Returns a member of an object. Throws InputError without the file's name, which result_from_json() adds.
const Json& at(const Json& json, const char* key)
{
    if (!json.is_object()) throw InputError(fmt::format("{} in the place of an object", json.type_name()));
    const auto found = json.find(key);
    if (found == json.end()) throw InputError(fmt::format("'{}' is missing", key));
    return *found;
}

[[noreturn]] void refuse(const char* key, const Json& value, const std::string& expected)
{
    throw InputError(fmt::format("{}: {} given, expected {}", key, printable(value.dump(), 80), expected));
}

std::string text_at(const Json& json, const char* key)
{
    const Json& value = at(json, key);
    if (!value.is_string()) refuse(key, value, "a text");
    return value.get<std::string>();
}

std::string text_or_nothing_at(const Json& json, const char* key)
{
    return at(json, key).is_null() ? std::string() : text_at(json, key);
}

bool flag_at(const Json& json, const char* key)
{
    const Json& value = at(json, key);
    if (!value.is_boolean()) refuse(key, value, "true or false");
    return value.get<bool>();
}

std::uint64_t count_at(const Json& json, const char* key, std::uint64_t most = most_counted)
{
    const Json& value = at(json, key);
    const bool whole = value.is_number_unsigned() || (value.is_number_integer() && value.get<std::int64_t>() >= 0);
    if (!whole || value.get<std::uint64_t>() > most) {
        refuse(key, value, fmt::format("a whole number from 0 to {}", most));
    }
    return value.get<std::uint64_t>();
}

int whole_at(const Json& json, const char* key, int most = std::numeric_limits<int>::max())
{
    return static_cast<int>(count_at(json, key, static_cast<std::uint64_t>(most)));
}

double number(const char* key, const Json& value, double low, double high)
{
    const bool held = value.is_number() && value.get<double>() >= low && value.get<double>() <= high;
    if (!held) refuse(key, value, fmt::format("a number from {} to {}", low, high));
    return value.get<double>();
}

double number_at(const Json& json, const char* key, double low, double high)
{
    return number(key, at(json, key), low, high);
}

// Returns nullopt if the member is missing or null: older files lack some numbers, and so do some rows of newer files.
std::optional<double> known_number_at(const Json& json, const char* key, double low, double high)
{
    if (!json.contains(key) || at(json, key).is_null()) return std::nullopt;
    return number_at(json, key, low, high);
}

// Accepts times of 0 or less: for such samples `bench compare` reports that the configuration cannot be compared.
double seconds_at(const Json& json, const char* key) { return number_at(json, key, -most_seconds, most_seconds); }

double number_or_infinity_at(const Json& json, const char* key)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return at(json, key).is_null() ? infinity : number_at(json, key, -infinity, infinity);
}

// Calls read(element) for each element of a list. The messages of exceptions are extended by the element's place.
template <class Read>
void each_at(const Json& json, const char* key, const Read& read)
{
    const Json& list = at(json, key);
    if (!list.is_array()) refuse(key, list, "a list");
    for (std::size_t i = 0; i < list.size(); ++i) {
        try {
            read(list[i]);
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}[{}]: {}", key, i, error.what()));
        }
    }
}

Precision precision_at(const Json& json, const char* key)
{
    const std::string name = text_at(json, key);
    if (name == name_of(Precision::f32)) return Precision::f32;
    if (name == name_of(Precision::f64)) return Precision::f64;
    refuse(key, at(json, key), "float or double");
}

Mode mode_at(const Json& json, const char* key)
{
    const std::string name = text_at(json, key);
    if (name == name_of(Mode::exact)) return Mode::exact;
    if (name == name_of(Mode::fast)) return Mode::fast;
    refuse(key, at(json, key), "exact or fast");
}

Setting setting_at(const Json& parent, const char* key)
{
    const Json& json = at(parent, key);
    constexpr double wide = 1e6;
    return {.width = whole_at(json, "width", max_side),
            .height = whole_at(json, "height", max_side),
            .iterations = whole_at(json, "iterations"),
            .detail = number_at(json, "detail", -wide, wide),
            .power = number_at(json, "power", -wide, wide),
            .threads = whole_at(json, "threads"),
            .pack = whole_at(json, "pack"),
            .chunk = whole_at(json, "chunk"),
            .band = json.contains("band") ? whole_at(json, "band") : 0,  // older files have neither band nor block
            .block = json.contains("block") ? whole_at(json, "block") : 0,
            .without = text_at(json, "without"),
            .view = text_at(json, "view"),
            .frames = whole_at(json, "frames")};
}

Work work_at(const Json& parent, const char* key)
{
    const Json& json = at(parent, key);
    return {count_at(json, "steps"), count_at(json, "de_calls"), count_at(json, "iterations")};
}

Proof proof_at(const Json& parent, const char* key)
{
    const Json& json = at(parent, key);
    Proof p;
    p.drawn = flag_at(json, "drawn");
    p.passed = flag_at(json, "fine");
    p.yardstick = flag_at(json, "yardstick");
    p.level = text_at(json, "level");
    p.text = text_at(json, "text");
    p.against = text_at(json, "against");
    p.pixels = count_at(json, "pixels");
    p.differing = count_at(json, "differing");
    p.visibly_differing = count_at(json, "visibly_differing");
    p.largest_ulps = number_or_infinity_at(json, "largest_ulps");
    p.psnr = number_or_infinity_at(json, "psnr_db");
    return p;
}

Sample sample_of(const Json& json)
{
    return {.launch = whole_at(json, "launch"),
            .round = whole_at(json, "round"),
            .kernel = seconds_at(json, "kernel"),
            .wall = seconds_at(json, "wall"),
            .upload = seconds_at(json, "upload"),
            .readback = seconds_at(json, "readback"),
            // Older files have no `host`: their kernel time was measured by the host's clock.
            .host = seconds_at(json, json.contains("host") ? "host" : "kernel")};
}

Row row_of(const Json& json)
{
    Row row;
    row.fractal = text_at(json, "fractal");
    row.precision = precision_at(json, "precision");
    row.mode = mode_at(json, "mode");
    row.backend = text_at(json, "backend");
    row.device = whole_at(json, "device");
    row.point = text_at(json, "point");
    row.setting = setting_at(json, "setting");
    row.unavailable = text_or_nothing_at(json, "unavailable");
    row.failure = text_or_nothing_at(json, "failure");
    row.platform = text_at(json, "platform");
    row.device_name = text_at(json, "device_name");
    row.vendor = text_at(json, "vendor");
    row.driver = text_at(json, "driver");
    row.is_gpu = flag_at(json, "is_gpu");
    row.instruction_set = text_at(json, "instruction_set");
    row.threads = whole_at(json, "threads");
    row.pack = whole_at(json, "pack");
    row.proof = proof_at(json, "proof");
    row.context = seconds_at(json, "context_seconds");
    row.build = seconds_at(json, "build_seconds");
    // These members are missing in older files of version 1.
    row.step_factor = known_number_at(json, "stride", 0, 1).value_or(0);
    if (json.contains("unsettled")) row.unsettled = number_at(json, "unsettled", 0, 1);
    row.work = work_at(json, "work");
    row.operations = number_at(json, "operations", 0, most_rate);
    row.operations_error = known_number_at(json, "operations_standard_error", 0, most_rate);
    each_at(json, "samples", [&](const Json& sample) { row.samples.push_back(sample_of(sample)); });
    return row;
}

Counted counted_of(const Json& json)
{
    Counted c;
    c.fractal = text_at(json, "fractal");
    c.precision = precision_at(json, "precision");
    c.mode = mode_at(json, "mode");
    c.setting = setting_at(json, "setting");
    for (int i = 0; i < stage_count; ++i) {
        const Json& o = at(at(json, "stages"), std::string(name_of(static_cast<Stage>(i))).c_str());
        c.count.stages.at(static_cast<std::size_t>(i)) = {count_at(o, "sums"), count_at(o, "products"),
                                                          count_at(o, "quotients"), count_at(o, "roots")};
    }
    c.count.pixels = count_at(json, "pixels");
    c.count.hits = count_at(json, "hits");
    c.count.work = work_at(json, "work");
    c.count.march_estimates = count_at(json, "march_de_calls");
    c.count.march_iterations = count_at(json, "march_iterations");
    const auto active = [](const Json& use, const std::string& how) {
        return ActiveLanes{number_at(use, (how + "active_in_steps").c_str(), 0, 1),
                           number_at(use, (how + "active_in_iterations").c_str(), 0, 1)};
    };
    if (json.contains("standard_errors")) {
        const Json& errors = at(json, "standard_errors");
        c.count.errors = {.per_iteration = number_at(errors, "operations_per_iteration", 0, most_rate),
                          .per_estimate = number_at(errors, "march_iterations_per_de_call", 0, most_rate)};
    }
    if (json.contains("lane_use")) {
        each_at(json, "lane_use", [&](const Json& use) {
            LaneUse& read = c.count.lane_use.emplace_back(
                LaneUse{whole_at(use, "lanes"), active(use, ""), active(use, "refilled_")});
            if (!use.contains("standard_errors")) return;
            read.together_error = active(at(use, "standard_errors"), "");
            read.refilled_error = active(at(use, "standard_errors"), "refilled_");
        });
        if (c.count.lane_use.empty()) throw InputError("lane_use: [] given, expected the use of some lanes");
    } else {  // older files have one vector length only
        c.count.lane_use.push_back({whole_at(json, "lanes"), active(json, ""), std::nullopt});
    }
    return c;
}

StageTime stage_of(const Json& json)
{
    StageTime stage{
        text_at(json, "fractal"), precision_at(json, "precision"), mode_at(json, "mode"), text_at(json, "stage"), {}};
    each_at(json, "seconds",
            [&](const Json& seconds) { stage.seconds.push_back(number("seconds", seconds, 0, most_seconds)); });
    return stage;
}

Result result_of(const Json& json)
{
    if (text_at(json, "schema") != "mandelmarch-bench") throw InputError("no result of bench");
    if (const Json& version = at(json, "version"); version != schema_version) {
        throw InputError(
            fmt::format("version {} of the result format, expected {}", printable(version.dump(), 80), schema_version));
    }
    Result result;
    result.study = text_at(json, "study");
    result.seed = count_at(json, "seed");
    result.launches = whole_at(json, "launches");
    result.environment = at(json, "environment");
    if (!result.environment.is_object()) refuse("environment", result.environment, "an object");
    each_at(json, "warnings", [&](const Json& warning) {
        if (!warning.is_string()) refuse("warning", warning, "a text");
        result.warnings.push_back(warning);
    });
    each_at(json, "peaks", [&](const Json& p) {
        result.peaks.push_back({text_at(p, "platform"), text_at(p, "backend"), whole_at(p, "device"),
                                precision_at(p, "precision"), number_at(p, "operations_per_second", 0, most_rate)});
    });
    each_at(json, "counts", [&](const Json& counted) { result.counts.push_back(counted_of(counted)); });
    each_at(json, "stages", [&](const Json& stage) { result.stages.push_back(stage_of(stage)); });
    std::set<std::string> names;
    each_at(json, "rows", [&](const Json& row) {
        result.rows.push_back(row_of(row));
        const std::string name = result.rows.back().name();
        if (!names.insert(name).second) throw InputError(printable(name, 200) + " is there twice");
    });
    return result;
}

}  // namespace

Result result_from_json(const Json& json, const std::string& name)
{
    try {
        return result_of(json);
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}, expected a result of bench --json", name, error.what()));
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: no result of bench: {}", name, error.what()));
    }
}

Result parse_result(const std::string& text, const std::string& name)
{
    check_json_depth(text, name);
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_discarded()) throw InputError(name + ": no JSON, expected a result file of bench --json");
    return result_from_json(json, name);
}

}  // namespace mandelmarch::bench
