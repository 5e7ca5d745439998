// SPDX-License-Identifier: Apache-2.0
#include "bench/result/differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

// Parts of an environment that differ from measurement to measurement on one machine.
constexpr std::string_view passing[] = {"date",    "cpu/megahertz", "memory/available_bytes",
                                        "os/boot", "during",        "telemetry"};

std::string words(const Json& value)
{
    if (value.is_null()) return "unknown";
    return printable(value.is_string() ? value.get<std::string>() : value.dump(), 200);
}

// Returns the elements of a list that another one lacks, separated by spaces; "none" if there are none.
std::string only_in(const Json& list, const Json& other)
{
    std::string only;
    for (const Json& element : list) {
        if (std::ranges::find(other, element) != other.end()) continue;
        only += (only.empty() ? "" : " ") + words(element);
    }
    return only.empty() ? "none" : printable(only, 200);
}

bool is_named(const Json& list)
{
    return list.is_array() &&
           std::ranges::all_of(list, [](const Json& element) { return value_at(element, "/name").is_string(); });
}

// Adds a line for each difference of two values at a place of the environment, such as "cpu/model".
void add_differences(const std::string& place, const Json& before, const Json& after, std::vector<std::string>& lines)
{
    if (same_fact(before, after) || std::ranges::find(passing, place) != std::end(passing)) return;
    const auto below = [&](const std::string& key) { return place.empty() ? key : place + "/" + key; };
    if (is_named(before) && is_named(after)) {
        // Backends and devices that only one result has are skipped, because the table of configurations shows them.
        for (const Json& element : after) {
            const auto same =
                std::ranges::find(before, element.at("name"), [](const Json& one) { return one.at("name"); });
            if (same != before.end()) add_differences(below(words(element.at("name"))), *same, element, lines);
        }
    } else if (before.is_array() && after.is_array()) {
        lines.push_back(fmt::format("{}: {} in the old result only, {} in the new only", place, only_in(before, after),
                                    only_in(after, before)));
    } else if (before.is_object() && after.is_object()) {
        Json both = before;
        both.update(after);
        for (const auto& [key, value] : both.items()) {
            add_differences(below(key), before.value(key, Json()), after.value(key, Json()), lines);
        }
    } else {
        lines.push_back(fmt::format("{}: {} in the old result, {} in the new", place, words(before), words(after)));
    }
}

}  // namespace

Json value_at(const Json& environment, const std::string& pointer)
{
    const Json::json_pointer place(pointer);
    return environment.contains(place) ? environment.at(place) : Json();
}

bool same_fact(const Json& one, const Json& other)
{
    const auto sorted = [](const Json& fact) {
        nlohmann::json made = fact;  // its keys are sorted
        if (made.is_array()) std::sort(made.begin(), made.end());
        return made;
    };
    return sorted(one) == sorted(other);
}

std::vector<std::string> differences_of(const Json& old_environment, const Json& new_environment)
{
    std::vector<std::string> lines;
    add_differences("", old_environment, new_environment, lines);
    return lines;
}

}  // namespace mandelmarch::bench
