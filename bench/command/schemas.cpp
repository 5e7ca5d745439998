// SPDX-License-Identifier: Apache-2.0
// The kinds of files that bench writes: their JSON Schemas and their derived figures, both from the descriptions of
// their records (bench/result/fields.h).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bench/command/commands.h"
#include "bench/fidelity/scene_fields.h"
#include "bench/result/result_fields.h"
#include "bench/result/result_file.h"
#include "core/text/error.h"
#include "core/text/text.h"

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

template <class Record>
Json record_schema(Json& definitions)
{
    Json properties = Json::object(), required = Json::array();
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
        if (field.rule.required) required.push_back(field.key);
    });
    Json schema{{"type", "object"}, {"properties", std::move(properties)}};
    if (!required.empty()) schema["required"] = std::move(required);
    return schema;
}

template <class Number>
Json number_schema(const Rule& rule)
{
    Json schema{{"type", std::is_floating_point_v<Number> ? "number" : "integer"}};
    const auto limit = [&](const char* key, double value) {
        if (std::abs(value) >= 1e9) return;  // serves to detect damaged files only
        schema[key] = std::trunc(value) == value ? Json(static_cast<std::int64_t>(value)) : Json(value);
    };
    limit("minimum", rule.min);
    limit("maximum", rule.max);
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
        return {{"type", "object"}};
    } else if constexpr (Map<T>) {
        return {{"type", "object"}, {"additionalProperties", schema_of<typename T::mapped_type>(rule, definitions)}};
    } else if constexpr (Keyed<T>) {
        Json properties = Json::object();
        for (const char* key : keys_of<T>) {
            properties[key] = schema_of<typename T::value_type>(rule, definitions);
        }
        return {{"type", "object"}, {"properties", std::move(properties)}};
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
    Format format;  // without a name: the file is a list without "schema"
    const char* title;
    const char* about;
    Json (*content)(Json& definitions);                          // returns the schema of the record or list
    Json (*derived)(const Json& json, const std::string& name);  // see derived_json()
};

constexpr Kind kinds[] = {
    {"result", format_of<Result>, "A result of bench",
     "Times are in seconds, rates per second. An operation is an addition, subtraction, multiplication, division or "
     "square root in one lane. docs/bench-output.md explains every quantity.",
     record_schema<Result>,
     [](const Json& json, const std::string& file) { return json_of(result_from_json(json, file)); }},
    {"random", format_of<RandomResult>, "Fast pictures of random scenes",
     "Written by `bench random --json`. A pixel counts as off if it differs by more than 2 of 255 from the canonical "
     "picture.",
     record_schema<RandomResult>,
     [](const Json& json, const std::string& file) {
         return document(summed(record_of<RandomResult>(json, file)), Form::derived);
     }},
    {"equivalence", format_of<EquivalenceResult>, "An equivalence test", "Written by `bench equivalence --json`.",
     record_schema<EquivalenceResult>, [](const Json& json, const std::string& /*file*/) { return json; }},
    {"portability",
     {},
     "Performance portability",
     "Written by `bench portability --json`: the same list as `portability` in a result.",
     [](Json& definitions) { return schema_of<std::vector<Portability>>({}, definitions); },
     nullptr},
};

Json schema_json(const Kind& kind)
{
    const bool is_list = kind.format.schema == nullptr;
    Json definitions = Json::object();
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"title", is_list ? kind.title : fmt::format("{}, version {}", kind.title, kind.format.version)},
                {"description", fmt::format("{}{}", kind.about,
                                            is_list ? ""
                                                    : " A file holds facts; `bench json FILE` "
                                                      "prints all properties.")}};
    Json content = kind.content(definitions);
    if (!is_list) {
        content["properties"]["schema"] = {{"const", kind.format.schema}};
        content["properties"]["version"] = {{"const", kind.format.version}};
        content["required"].push_back("schema");
        content["required"].push_back("version");
    }
    schema.update(content);
    schema["$defs"] = std::move(definitions);
    return schema;
}

}  // namespace

std::string derived_json(const std::string& path)
{
    const Json json = json_in(path);
    const auto* const kind = std::ranges::find_if(
        kinds, [&](const Kind& one) { return one.format.schema != nullptr && schema_in(json) == one.format.schema; });
    if (kind == std::end(kinds)) throw InputError(path + ": not a file of bench, expected a result of --json");
    return text_of(kind->derived(json, path));
}

std::string schema_text(const std::string& name)
{
    const auto* const kind = std::ranges::find(kinds, std::string_view(name), &Kind::name);
    if (kind != std::end(kinds)) return text_of(schema_json(*kind));
    throw InputError(
        fmt::format("bench schema: '{}' given, expected one of {}", name, fmt::join(mapped(kinds, &Kind::name), ", ")));
}

Json facts_of(const RandomResult& result) { return document(result, Form::facts); }

Json facts_of(const EquivalenceResult& result) { return document(result, Form::facts); }

}  // namespace mandelmarch::bench
