// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "bench/result/figures.h"
#include "bench/files/gpu_reading.h"
#include "bench/judge/differences.h"
#include "bench/judge/portability.h"
#include "bench/files/result_file.h"
#include "bench/files/result_fields.h"
#include "bench/files/version1.h"
#include "core/base/error.h"
#include "core/base/input_file.h"
#include "core/base/json.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

constexpr std::string_view result_kind = "result file of bench --json";

// Returns the JSON in the text; if the text is not JSON, a value for which is_discarded() is true.
Json parsed(const std::string& text, const std::string& name)
{
    try {
        return parse_json<Json>(text, name);
    } catch (const Json::exception&) {
        return Json::value_t::discarded;
    }
}

Json schema_in(const Json& json) { return json.is_object() ? json.value("schema", Json()) : Json(); }

// Throws Refusal if two configurations have the same name, if operation counts have no lane utilisation, or if a GPU's
// readings are impossible.
void check(const Result& result)
{
    if (const Json gpus = value_at(result.environment, "/telemetry/gpus"); gpus.is_array()) {
        std::vector<GpuReading> readings;
        at_place("environment.telemetry.gpus", [&] { from_json(gpus, readings); });
    }
    std::set<std::string> names;
    for (const Row& row : result.rows) {
        if (!names.insert(row.name()).second) throw Refusal{"rows", printable(row.name(), 200) + " is there twice"};
    }
    for (std::size_t i = 0; i < result.counts.size(); ++i) {
        if (result.counts[i].lane_use.empty()) {
            throw Refusal{fmt::format("counts[{}].lane_use", i), "[] given, expected the use of some lanes"};
        }
    }
}

// Returns the result that the JSON holds. Throws Refusal if it is not a valid result.
Result result_of(Json json)
{
    if (schema_in(json) != result_schema) throw Refusal{"", "not a result of bench"};
    upgrade(json);
    if (const Json version = json.value("version", Json()); version != schema_version) {
        throw Refusal{"", fmt::format("version {} of the result format, expected {}", printable(version.dump(), 80),
                                      schema_version)};
    }
    Result result;
    from_json(json, result);
    check(result);
    return derived(std::move(result));
}

}  // namespace

Json json_of(const Result& result)
{
    Json json = document(result_schema, schema_version, result);
    json["portability"] = json_of(portability({&result, 1}));
    json["winners"] = to_json(contests_of(result));
    return json;
}

Json json_of(const std::vector<Portability>& portabilities)
{
    Json list = Json::array();
    for (const Portability& p : portabilities) {
        if (!p.platforms.empty()) list.push_back(to_json(p));
    }
    return list;
}

Result result_from_json(const Json& json, const std::string& name)
{
    try {
        return result_of(json);
    } catch (const Refusal& refusal) {
        throw InputError(fmt::format("{}: {}{}{}, expected a result of bench --json", name, refusal.place,
                                     refusal.place.empty() ? "" : ": ", refusal.why));
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("{}: not a result of bench: {}", name, error.what()));
    }
}

Result parse_result(const std::string& text, const std::string& name)
{
    const Json json = parsed(text, name);
    if (json.is_discarded()) throw InputError(name + ": not JSON, expected a result file of bench --json");
    return result_from_json(json, name);
}

Result read_result(const std::string& path) { return parse_result(text_of_file(path, result_kind), path); }

std::optional<Result> read_if_result(const std::string& path)
{
    const Json json = parsed(text_of_file(path, result_kind), path);
    if (schema_in(json) != result_schema) return std::nullopt;
    return result_from_json(json, path);
}

Json upgraded_json(const std::string& path)
{
    Json json = parsed(text_of_file(path, result_kind), path);
    const Json schema = schema_in(json);
    if (!schema.is_string()) throw InputError(path + ": not a file of bench, expected a result of --json");
    if (schema == result_schema) return json_of(result_from_json(json, path));
    upgrade(json);
    return json;
}

std::vector<std::string> result_files(const std::vector<std::string>& paths)
{
    namespace fs = std::filesystem;
    std::vector<std::string> files;
    for (const std::string& path : paths) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            files.push_back(path);
            continue;
        }
        std::vector<std::string> found;
        for (const auto& entry : fs::recursive_directory_iterator(path, error)) {
            if (entry.path().extension() == ".json") found.push_back(entry.path().string());
        }
        if (error) throw InputError(fmt::format("{}: cannot be read: {}", path, error.message()));
        std::ranges::sort(found);
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace mandelmarch::bench
