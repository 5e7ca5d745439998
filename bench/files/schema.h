// SPDX-License-Identifier: Apache-2.0
// JSON Schema of described records (bench/files/fields.h).
#pragma once

#include <string>

#include "bench/files/fields.h"

namespace mandelmarch::bench {

// Returns the schema of a value. Adds the schemas of the records in it to `definitions`.
template <class T>
Json schema_of(const Rule& rule, Json& definitions);

inline Json nullable(Json schema)
{
    if (schema.contains("type")) {
        schema["type"] = Json{schema["type"], "null"};
        return schema;
    }
    return {{"oneOf", {{{"type", "null"}}, schema}}};
}

inline Json object_schema(Json properties)
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
inline constexpr double most_limited = 1e9;

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
        if (!definitions.contains(Fields<T>::name)) {
            definitions[Fields<T>::name] = Json();  // reserves its place in front of the records that it contains
            Json schema = record_schema<T>(definitions);
            definitions[Fields<T>::name] = std::move(schema);
        }
        return {{"$ref", std::string("#/$defs/") + Fields<T>::name}};
    } else if constexpr (Named<T>) {
        Json names = Json::array();
        for (const auto value : Names<T>::values) names.push_back(name_of(value));
        return {{"enum", names}};
    } else if constexpr (std::is_same_v<T, Interval>) {
        return {{"type", "array"}, {"items", {{"type", "number"}}}, {"minItems", 2}, {"maxItems", 2}};
    } else if constexpr (std::is_same_v<T, Json>) {
        return {{"$ref", "https://mandelmarch.invalid/bench/schemas/environment.schema.json"}};
    } else if constexpr (Map<T>) {
        return {{"type", "object"}, {"additionalProperties", schema_of<typename T::mapped_type>(rule, definitions)}};
    } else if constexpr (Keyed<T>) {
        Json properties = Json::object();
        for (const char* key : Keys<T>::list) {
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

}  // namespace mandelmarch::bench
