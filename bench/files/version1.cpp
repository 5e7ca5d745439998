// SPDX-License-Identifier: Apache-2.0
#include "bench/files/version1.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;
using Names = std::pair<std::string_view, std::string_view>;  // the name in version 1, the name in version 2

constexpr Names keys[] = {{"block", "block_size"},      {"fine", "passed"},
                          {"largest_ulps", "max_ulps"}, {"launch", "run"},
                          {"launches", "runs"},         {"pack", "simd_width"},
                          {"point", "sweep_value"},     {"products", "multiplications"},
                          {"proof", "verification"},    {"quotients", "divisions"},
                          {"roots", "square_roots"},    {"stride", "step_factor"},
                          {"sums", "additions"},        {"yardstick", "is_expected"}};

// Parts of texts to replace: sweep values, disabled optimisations, names of pictures, and the study of SIMD widths.
constexpr Names texts[] = {{"block=", "block-size="},
                           {"blocks", "block-sizes"},
                           {"normal", "gradient"},
                           {"occlusion", "shared-occlusion"},
                           {"pack=", "simd-width="},
                           {"root", "refinement"},
                           {"surroundings", "shared-occlusion"},
                           {"--pack", "--simd-width"},
                           {"packs", "simd-widths"},
                           {"yardstick", "expected picture"}};
constexpr std::string_view with_names[] = {"against", "level",       "name", "study",
                                           "subject", "sweep_value", "text", "without"};

std::string renamed(std::string text)
{
    for (const auto& [old_name, new_name] : texts) {
        const auto at = text.find(old_name);
        if (at != std::string::npos) text.replace(at, old_name.size(), new_name);
    }
    return text;
}

// Replaces the keys of version 1 in all objects except the environment, which has none of these keys.
void rename(Json& json)
{
    if (json.is_array()) {
        for (Json& element : json) rename(element);
    }
    if (!json.is_object()) return;
    Json with_new_keys = Json::object();
    for (auto& [key, value] : json.items()) {
        std::string name = key;
        for (const auto& [old_key, new_key] : keys) {
            if (key == old_key) name = new_key;
        }
        if (name != "environment") rename(value);
        const bool named = std::ranges::find(with_names, name) != std::end(with_names);
        with_new_keys[name] = named && value.is_string() ? Json(renamed(value)) : std::move(value);
    }
    json = std::move(with_new_keys);
}

void add(Json& json, const char* key, Json value)
{
    if (json.is_object() && !json.contains(key)) json[key] = std::move(value);
}

Json active_lanes(const Json& json, const std::string& how)
{
    const std::string steps = how + "active_in_steps";
    if (!json.is_object() || !json.contains(steps)) return {};
    return {{"in_steps", json[steps]}, {"in_iterations", json.value(how + "active_in_iterations", Json())}};
}

// Returns the list of lane utilisations. The oldest results have a single vector length, and no utilisation with
// refill.
Json lane_use(const Json& counted)
{
    Json list = Json::array();
    const Json uses = counted.value("lane_use", Json::array({counted}));
    for (const Json& use : uses) {
        const Json errors = use.contains("lane_use") ? Json() : use.value("standard_errors", Json());
        list.push_back({{"lanes", use.value("lanes", Json())},
                        {"together", active_lanes(use, "")},
                        {"refilled", active_lanes(use, "refilled_")},
                        {"together_standard_error", active_lanes(errors, "")},
                        {"refilled_standard_error", active_lanes(errors, "refilled_")}});
    }
    return list;
}

// Adds the fields that older builds did not write.
void complete(Json& result)
{
    for (Json& row : result["rows"]) {
        if (!row.is_object()) continue;
        add(row["setting"], "band", 0);
        add(row["setting"], "block_size", 0);
        add(row, "step_factor", nullptr);
        add(row, "unsettled", 0);
        add(row, "operations_standard_error", nullptr);
        for (Json& sample : row["samples"]) {
            // Builds without this field measured the kernel time by the host's clock.
            if (sample.is_object()) add(sample, "host", sample.value("kernel", Json()));
        }
    }
    for (Json& counted : result["counts"]) {
        if (!counted.is_object()) continue;
        add(counted["setting"], "band", 0);
        add(counted["setting"], "block_size", 0);
        counted["lane_use"] = lane_use(counted);
        add(counted, "standard_errors", nullptr);
    }
}

}  // namespace

void upgrade(Json& json)
{
    if (!json.is_object() || json.value("version", Json()) != 1) return;
    const Json schema = json.value("schema", Json());
    if (schema != "mandelmarch-bench" && schema != "mandelmarch-duel" && schema != "mandelmarch-bench-equivalence")
        return;
    rename(json);
    if (schema == "mandelmarch-bench") complete(json);
    json["version"] = 2;
}

}  // namespace mandelmarch::bench
