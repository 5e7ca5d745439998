// SPDX-License-Identifier: Apache-2.0
// The published JSON Schemas of the files that bench writes, generated from the descriptions of their records
// (bench/files/fields.h). bench/schemas has copies.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "bench/command/commands.h"
#include "bench/files/result_fields.h"
#include "bench/scenes/scene_fields.h"
#include "core/base/console.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

// Returns the schema of a value. Adds the schemas of the records in it to `definitions`.
template <class T>
Json schema_of(const Rule& rule, Json& definitions);

Json nullable(Json schema)
{
    if (schema.contains("type")) {
        schema["type"] = Json{schema["type"], "null"};
        return schema;
    }
    return {{"oneOf", {{{"type", "null"}}, schema}}};
}

Json object_schema(Json properties)
{
    Json required = Json::array();
    for (const auto& [key, schema] : properties.items()) required.push_back(key);
    return {{"type", "object"},
            {"additionalProperties", false},
            {"required", std::move(required)},
            {"properties", std::move(properties)}};
}

template <class Record>
Json record_schema(Json& definitions)
{
    Json properties = Json::object();
    each_field<Record>([&](const auto& field) {
        using T = Value<Record, decltype(field.member)>;
        Json& schema = properties[field.key];
        if constexpr (std::is_same_v<T, std::optional<Quotient>>) {
            schema = schema_of<std::optional<double>>(field.rule, definitions);
            properties[std::string(field.key) + "_interval"] = schema_of<std::optional<Interval>>({}, definitions);
        } else {
            schema = schema_of<T>(field.rule, definitions);
        }
        if (*field.rule.about != '\0') properties[field.key]["description"] = field.rule.about;
    });
    return object_schema(std::move(properties));
}

// Limits of at least this size are left out of the schemas, because they only serve to detect damaged files.
constexpr double most_limited = 1e9;

template <class Number>
Json number_schema(const Rule& rule)
{
    Json schema{{"type", std::is_floating_point_v<Number> ? "number" : "integer"}};
    const auto number = [](double limit) {
        return std::trunc(limit) == limit ? Json(static_cast<std::int64_t>(limit)) : Json(limit);
    };
    if (rule.min > -most_limited) schema["minimum"] = number(rule.min);
    if (rule.max < most_limited) schema["maximum"] = number(rule.max);
    return rule.null == Null::none ? schema : nullable(std::move(schema));
}

template <class T>
Json schema_of(const Rule& rule, Json& definitions)
{
    if constexpr (Described<T>) {
        if (!definitions.contains(fields_of<T>.name)) {
            definitions[fields_of<T>.name] = Json();  // reserves its place in front of the records that it contains
            Json schema = record_schema<T>(definitions);
            definitions[fields_of<T>.name] = std::move(schema);
        }
        return {{"$ref", std::string("#/$defs/") + fields_of<T>.name}};
    } else if constexpr (Named<T>) {
        Json names = Json::array();
        for (const auto value : values_of<T>) names.push_back(name_of(value));
        return {{"enum", names}};
    } else if constexpr (std::is_same_v<T, Interval>) {
        return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
    } else if constexpr (std::is_same_v<T, Json>) {
        return {{"$ref", "https://mandelmarch.invalid/bench/schemas/environment.schema.json"}};
    } else if constexpr (Map<T>) {
        return {{"type", "object"}, {"additionalProperties", schema_of<typename T::mapped_type>(rule, definitions)}};
    } else if constexpr (Keyed<T>) {
        Json properties = Json::object();
        for (const char* key : keys_of<T>) {
            properties[key] = schema_of<typename T::value_type>(rule, definitions);
        }
        return object_schema(std::move(properties));
    } else if constexpr (Optional<T>) {
        return nullable(schema_of<typename T::value_type>(rule, definitions));
    } else if constexpr (List<T>) {
        return {{"type", "array"}, {"items", schema_of<typename T::value_type>(rule, definitions)}};
    } else if constexpr (std::is_same_v<T, std::string>) {
        const Json schema{{"type", "string"}};
        return rule.null == Null::empty ? nullable(schema) : schema;
    } else if constexpr (std::is_same_v<T, bool>) {
        return {{"type", "boolean"}};
    } else {
        return number_schema<T>(rule);
    }
}

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
    std::string line = json.dump();
    const bool members = key == "properties" || key == "$defs" || line.find("\"properties\":") != std::string::npos;
    if (!json.is_object() || !members) return line;
    std::vector<std::string> lines;
    for (const auto& [name, value] : json.items()) {
        lines.push_back(fmt::format("{} {}: {}", indent, Json(name).dump(), compact(value, name, indent + " ")));
    }
    return fmt::format("{{\n{}\n{}}}", fmt::join(lines, ",\n"), indent);
}

}  // namespace

Run schema_command(CLI::App& app, Registry& /*registry*/)
{
    const auto name = std::make_shared<std::string>();
    std::vector<std::string> names;
    for (const Kind& kind : kinds) names.emplace_back(kind.name);
    app.add_option("KIND", *name, "kind of file")->required()->check(CLI::IsMember(names));
    return [name]() -> int {
        print("{}\n", compact(schema_json(*std::ranges::find(kinds, std::string_view(*name), &Kind::name))));
        return exit_success;
    };
}

Json json_of(const RandomResult& result) { return document("mandelmarch-bench-random", 1, result); }

Json json_of(const EquivalenceResult& result) { return document("mandelmarch-bench-equivalence", 2, result); }

}  // namespace mandelmarch::bench
