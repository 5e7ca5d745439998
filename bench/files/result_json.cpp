// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <set>

#include "bench/result/figures.h"
#include "bench/judge/portability.h"
#include "bench/files/result_file.h"
#include "bench/files/result_fields.h"
#include "bench/files/version1.h"
#include "core/base/error.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

// Throws Refusal.
void check(const Result& result)
{
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

// Throws Refusal.
Result result_of(Json json)
{
    if (!json.is_object() || json.value("schema", Json()) != result_schema) throw Refusal{"", "no result of bench"};
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

std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace mandelmarch::bench
