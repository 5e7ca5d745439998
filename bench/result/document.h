// SPDX-License-Identifier: Apache-2.0
// Files that hold one record each (bench/result/fields.h), with the name and the version of the file's format.
#pragma once

#include <string>

#include "bench/result/fields.h"
#include "core/text/error.h"

namespace mandelmarch::bench {

struct Format {
    const char* schema = nullptr;  // the value of "schema" in the file
    int version = 0;
};
// The format of the files that hold a record of this type.
template <class Record>
inline constexpr Format format_of{};

// Returns the contents of a file: the name and version of its format, then the record's fields.
template <class Record>
Json document(const Record& record, Form form)
{
    Json json{{"schema", format_of<Record>.schema}, {"version", format_of<Record>.version}};
    json.update(to_json(record, form));
    return json;
}

// Returns the value of "schema" in a file; null if there is none.
inline Json schema_in(const Json& json) { return json.is_object() ? json.value("schema", Json()) : Json(); }

// Reads a record from the contents of a file in either form. `name`: the file's name in messages; check(record): throws
// Refusal if the record is impossible. Throws InputError if the file has another format, or values that it cannot have.
template <class Record>
Record record_of(
    const Json& json, const std::string& name, void (*check)(const Record&) = [](const Record&) {})
{
    constexpr Format format = format_of<Record>;
    try {
        if (schema_in(json) != format.schema) throw Refusal{"", fmt::format("not a file of {}", format.schema)};
        if (const Json version = json.value("version", Json()); version != format.version) {
            throw Refusal{"", fmt::format("version {} of the format, expected {}", printable(version.dump(), 80),
                                          format.version)};
        }
        Record record;
        from_json(json, record);
        check(record);
        return record;
    } catch (const Refusal& refusal) {
        throw InputError(fmt::format("{}: {}{}{}, expected a result of bench --json", name, refusal.place,
                                     refusal.place.empty() ? "" : ": ", refusal.why));
    }
}

}  // namespace mandelmarch::bench
