// SPDX-License-Identifier: Apache-2.0
// Describes a record once, as a list of its fields. The JSON writer and reader, the columns of the CSV and the JSON
// Schema are derived from this list. To describe a record, specialise fields_of, as in bench/result/result_fields.h.
//
// A file holds facts alone. What follows from them is a derived field: it is printed, but neither stored nor read. The
// reader ignores keys that it does not know. If a file lacks a key, or has null, the member keeps its default, which
// means unknown; only what names a value and the times themselves are required.
//
// A field's value may be a bool, a number, a text, an enumeration (values_of), an Interval, JSON, a described record, a
// std::optional or std::vector of these, or a std::array with a name for each element (keys_of). A std::map whose keys
// are names is written, but not read.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "bench/statistics/statistics.h"
#include "core/text/text.h"

namespace mandelmarch::bench {

using Json = nlohmann::ordered_json;

// The value that is printed as null: an empty text, 0 or infinity. `none`: no value is.
enum class Null { none, empty, zero, infinite };

// The largest integer up to which JSON readers, which may use doubles, represent every integer exactly.
inline constexpr double max_integer = 0x1p53;

struct Rule {
    double min = 0, max = max_integer;  // limits of a number
    Null null = Null::none;
    bool timed = false;      // the field's CSV cells are empty for a configuration without a speed
    bool required = false;   // a file that lacks the value is damaged
    const char* about = "";  // description in the schema
};

// `stored`: false for a derived value.
template <class Member, bool stored>
struct Field {
    const char* key;
    Member member;       // pointer to the member, or a function of the record
    const char* column;  // name in the CSV; empty: no column
    Rule rule;
};
template <class Member>
constexpr Field<Member, true> field(const char* key, Member member, const char* column = "", Rule rule = {})
{
    return {key, member, column, rule};
}
template <class Member>
constexpr Field<Member, false> derived_field(const char* key, Member member, const char* column = "", Rule rule = {})
{
    return {key, member, column, rule};
}

// The record's name in the schema, and its fields.
template <class... Fields>
struct Description {
    const char* name;
    std::tuple<Fields...> list;

    explicit constexpr Description(const char* record, Fields... fields) : name(record), list(fields...) {}
};

// The description of a record, the values of an enumeration, whose texts name_of() returns, and the keys of an array
// that is stored as an object; nullptr for other types.
template <class Record>
inline constexpr std::nullptr_t fields_of = nullptr;
template <class Enum>
inline constexpr std::nullptr_t values_of = nullptr;
template <class Array>
inline constexpr std::nullptr_t keys_of = nullptr;

template <class T>
concept Described = !std::is_null_pointer_v<decltype(fields_of<T>)>;
template <class T>
concept Named = !std::is_null_pointer_v<decltype(values_of<T>)>;
template <class T>
concept Keyed = !std::is_null_pointer_v<decltype(keys_of<T>)>;

template <class T>
concept Map = requires
{
    typename T::mapped_type;
};
template <class T>
concept Optional = requires(const T& value)
{
    value.has_value();
};
template <class T>
concept List = std::is_same_v<T, std::vector<typename T::value_type>>;

// Calls each(field) for the fields of a record, in their order.
template <class Record, class Each>
void each_field(const Each& each)
{
    std::apply([&](const auto&... fields) { (each(fields), ...); }, fields_of<Record>.list);
}

template <class Record, class Member>
using Value = std::remove_cvref_t<std::invoke_result_t<Member, const Record&>>;

// The forms of a record in JSON: as a file holds it, or with all derived fields.
enum class Form { facts, derived };

// Returns the value as JSON.
template <class T>
Json to_json(const T& value, Form form, const Rule& rule = {});

template <class Record>
Json record_to_json(const Record& record, Form form)
{
    Json json = Json::object();
    each_field<Record>([&]<class Member, bool stored>(const Field<Member, stored>& field) {
        if (!stored && form == Form::facts) return;
        const auto& value = std::invoke(field.member, record);
        if constexpr (Optional<std::remove_cvref_t<decltype(value)>>) {
            if (!value && form == Form::facts) return;
        }
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, std::optional<Quotient>>) {
            // Two members: KEY with the ratio, and KEY_interval.
            json[field.key] = value ? Json(value->ratio) : Json();
            json[std::string(field.key) + "_interval"] = value ? to_json(value->interval, form) : Json();
        } else {
            json[field.key] = to_json(value, form, field.rule);
        }
    });
    return json;
}

template <class T>
Json to_json(const T& value, Form form, const Rule& rule)
{
    if constexpr (Described<T>) {
        return record_to_json(value, form);
    } else if constexpr (Named<T>) {
        return Json(name_of(value));
    } else if constexpr (std::is_same_v<T, Interval>) {
        return Json{value.low, value.high};
    } else if constexpr (std::is_same_v<T, Json>) {
        return value;
    } else if constexpr (Optional<T>) {
        return value ? to_json(*value, form, rule) : Json();
    } else if constexpr (Map<T>) {
        Json json = Json::object();
        for (const auto& [key, element] : value) json[key] = to_json(element, form, rule);
        return json;
    } else if constexpr (Keyed<T>) {
        Json json = Json::object();
        for (std::size_t i = 0; i < value.size(); ++i) json[keys_of<T>[i]] = to_json(value[i], form, rule);
        return json;
    } else if constexpr (List<T>) {
        Json list = Json::array();
        for (const auto& element : value) list.push_back(to_json(element, form, rule));
        return list;
    } else if constexpr (std::is_same_v<T, std::string>) {
        return rule.null == Null::empty && value.empty() ? Json() : Json(value);
    } else if constexpr (std::is_floating_point_v<T>) {
        const bool null =
            (rule.null == Null::zero && value == 0) || (rule.null == Null::infinite && !std::isfinite(value));
        return null ? Json() : Json(value);
    } else {
        return Json(value);
    }
}

// The reason why a value cannot be read, and the value's place in the file: "rows[3].setting.width".
struct Refusal {
    std::string place, why;
};

[[noreturn]] inline void refuse(const Json& json, const std::string& expected)
{
    throw Refusal{"", fmt::format("{} given, expected {}", printable(json.dump(), 80), expected)};
}

// Reads a value of a file. Throws Refusal if the JSON does not hold a valid value.
template <class T>
void from_json(const Json& json, T& value, const Rule& rule = {});

// Calls read(). If read() throws a Refusal, puts `place` in front of the Refusal's place and throws it again.
template <class Read>
void at_place(const std::string& place, const Read& read)
{
    try {
        read();
    } catch (Refusal& refusal) {
        const bool inner = !refusal.place.empty() && refusal.place.front() != '[';
        refusal.place = place + (inner ? "." : "") + refusal.place;
        throw;
    }
}

// Reads a member of an object. If it is missing or null, the value stays as it is; infinite, if null means that.
template <class T>
void member_from_json(const Json& json, const char* key, T& value, const Rule& rule)
{
    const auto found = json.find(key);
    if (found != json.end() && !found->is_null()) {
        at_place(key, [&] { from_json(*found, value, rule); });
    } else if (rule.required) {
        throw Refusal{"", fmt::format("'{}' is missing", key)};
    } else if constexpr (std::is_floating_point_v<T>) {
        if (rule.null == Null::infinite) value = std::numeric_limits<T>::infinity();
    }
}

template <class Record>
void record_from_json(const Json& json, Record& record)
{
    if (!json.is_object()) refuse(json, "an object");
    each_field<Record>([&]<class Member, bool stored>(const Field<Member, stored>& field) {
        if constexpr (stored) member_from_json(json, field.key, record.*field.member, field.rule);
    });
}

template <Named Enum>
void name_from_json(const Json& json, Enum& value)
{
    std::string names;
    for (const Enum one : values_of<Enum>) {
        if (json.is_string() && json.get_ref<const std::string&>() == name_of(one)) {
            value = one;
            return;
        }
        names += fmt::format("{}{}", names.empty() ? "" : " or ", name_of(one));
    }
    refuse(json, names);
}

template <class Number>
void number_from_json(const Json& json, Number& value, const Rule& rule)
{
    if constexpr (std::is_floating_point_v<Number>) {
        if (!json.is_number() || !(json.get<double>() >= rule.min && json.get<double>() <= rule.max)) {
            refuse(json, fmt::format("a number from {} to {}", rule.min, rule.max));
        }
    } else {
        const double max = std::min(rule.max, static_cast<double>(std::numeric_limits<Number>::max()));
        const bool held = json.is_number_integer() && json.get<double>() >= rule.min && json.get<double>() <= max;
        if (!held) refuse(json, fmt::format("a whole number from {:.0f} to {:.0f}", rule.min, max));
    }
    value = json.get<Number>();
}

template <class T>
void from_json(const Json& json, T& value, const Rule& rule)
{
    if constexpr (Described<T>) {
        record_from_json(json, value);
    } else if constexpr (Named<T>) {
        name_from_json(json, value);
    } else if constexpr (std::is_same_v<T, Json>) {
        if (!json.is_object()) refuse(json, "an object");
        value = json;
    } else if constexpr (Optional<T>) {
        from_json(json, value.emplace(), rule);
    } else if constexpr (Keyed<T>) {
        if (!json.is_object()) refuse(json, "an object");
        for (std::size_t i = 0; i < value.size(); ++i) member_from_json(json, keys_of<T>[i], value[i], rule);
    } else if constexpr (List<T>) {
        if (!json.is_array()) refuse(json, "a list");
        for (std::size_t i = 0; i < json.size(); ++i) {
            at_place(fmt::format("[{}]", i), [&] { from_json(json[i], value.emplace_back(), rule); });
        }
    } else if constexpr (std::is_same_v<T, std::string>) {
        if (!json.is_string()) refuse(json, "a text");
        value = json.get<std::string>();
    } else if constexpr (std::is_same_v<T, bool>) {
        if (!json.is_boolean()) refuse(json, "true or false");
        value = json.get<bool>();
    } else {
        number_from_json(json, value, rule);
    }
}

}  // namespace mandelmarch::bench
