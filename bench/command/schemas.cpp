// SPDX-License-Identifier: Apache-2.0
#include "bench/command/schemas.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/contest/contest_fields.h"
#include "bench/files/result_fields.h"
#include "bench/scenes/scene_fields.h"
#include "bench/files/schema.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

struct Kind {
    const char* name;
    const char* schema;  // the value of "schema" in a file of this kind; nullptr: the file is a list without "schema"
    int version;
    const char* title;
    const char* about;
    Json (*content)(Json& definitions);  // returns the schema of the record or list
};

template <class Record>
Json properties_of(Json& definitions)
{
    return record_schema<Record>(definitions);
}

// Returns the schema of a result's fields, including `portability` and `winners`, which are computed from several rows.
Json result_properties(Json& definitions)
{
    Json schema = record_schema<Result>(definitions);
    schema["properties"]["portability"] = schema_of<std::vector<Portability>>({}, definitions);
    schema["required"].push_back("portability");
    schema["properties"]["winners"] = schema_of<std::vector<Contest>>({}, definitions);
    schema["properties"]["winners"]["description"] =
        "Only in results of a standard study; missing in those of older builds.";
    return schema;
}

constexpr Kind kinds[] = {
    {"portability", nullptr, 0, "Performance portability",
     "Written by `bench portability --json`: the same list as `portability` in a result.",
     [](Json& definitions) { return schema_of<std::vector<Portability>>({}, definitions); }},
    {"result", result_schema, schema_version, "A result of bench",
     "Times are in seconds, rates per second. An operation is an addition, subtraction, multiplication, division or "
     "square root in one lane. docs/bench-output.md explains every quantity.",
     result_properties},
    {"duel", "mandelmarch-duel", 2, "A duel",
     "Written by `bench duel --json`: times of pairs of pictures by two programs, and the verdicts. All times are in "
     "seconds, by the clock that `clock` names.",
     properties_of<Duel>},
    {"race", "mandelmarch-race", 2, "A race",
     "Written by `bench race --json`: programs that read a parameter file and write a picture, ours first. Times are "
     "in seconds, of whole processes; memory is in bytes.",
     properties_of<Race>},
    {"random", "mandelmarch-bench-random", 1, "Fast pictures of random scenes",
     "Written by `bench random --json`. A pixel counts as off if it differs by more than 2 of 255 from the canonical "
     "picture.",
     properties_of<RandomResult>},
    {"equivalence", "mandelmarch-bench-equivalence", 2, "An equivalence test", "Written by `bench equivalence --json`.",
     properties_of<EquivalenceResult>},
};

Json schema_json(const Kind& kind)
{
    const bool is_list = kind.schema == nullptr;
    Json definitions = Json::object();
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"$id", fmt::format("https://mandelmarch.invalid/bench/schemas/{}.schema.json", kind.name)},
                {"title", is_list ? kind.title : fmt::format("{}, version {}", kind.title, kind.version)},
                {"description", kind.about}};
    Json content = kind.content(definitions);
    if (!is_list) {
        Json properties{{"schema", {{"const", kind.schema}}}, {"version", {{"const", kind.version}}}};
        properties.update(content["properties"]);
        Json required = {"schema", "version"};
        for (const Json& key : content["required"]) required.push_back(key);
        content["properties"] = std::move(properties);
        content["required"] = std::move(required);
    }
    schema.update(content);
    schema["$defs"] = std::move(definitions);
    return schema;
}

// Formats a schema with one line for each property.
std::string compact(const Json& json, const std::string& key = "", const std::string& indent = "")
{
    const std::string line = json.dump();
    const bool members = key == "properties" || key == "$defs" || line.find("\"properties\":") != std::string::npos;
    if (!json.is_object() || !members) return line;
    std::vector<std::string> lines;
    for (const auto& [name, value] : json.items()) {
        lines.push_back(fmt::format("{} {}: {}", indent, Json(name).dump(), compact(value, name, indent + " ")));
    }
    return fmt::format("{{\n{}\n{}}}", fmt::join(lines, ",\n"), indent);
}

}  // namespace

std::vector<std::string> schema_kinds()
{
    std::vector<std::string> names;
    for (const Kind& kind : kinds) names.emplace_back(kind.name);
    return names;
}

std::string schema_text(std::string_view name)
{
    const auto* const kind = std::ranges::find(kinds, name, &Kind::name);
    if (kind == std::end(kinds)) {
        throw InputError(
            fmt::format("bench schema: '{}' given, expected one of {}", name, fmt::join(schema_kinds(), ", ")));
    }
    return compact(schema_json(*kind)) + "\n";
}

Json json_of(const Duel& duel) { return document("mandelmarch-duel", 2, duel); }

Json json_of(const Race& race) { return document("mandelmarch-race", 2, race); }

Json json_of(const RandomResult& result) { return document("mandelmarch-bench-random", 1, result); }

Json json_of(const EquivalenceResult& result) { return document("mandelmarch-bench-equivalence", 2, result); }

}  // namespace mandelmarch::bench
