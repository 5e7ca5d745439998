// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/print/printers.h"
#include "bench/result/figures.h"
#include "bench/result/result_fields.h"

namespace mandelmarch::bench {
namespace {

using Cells = std::vector<std::string>;

template <class T>
std::string cell_of(const T& value)
{
    if constexpr (std::is_same_v<T, std::string>) return csv_cell(value);
    if constexpr (std::is_same_v<T, bool>) return value ? "1" : "0";
    if constexpr (Named<T>) return std::string(name_of(value));
    if constexpr (List<T>) return fmt::format("{}", value.size());
    if constexpr (Optional<T>) return value ? cell_of(*value) : std::string();
    if constexpr (std::is_arithmetic_v<T>) return fmt::format("{}", value);
}

// Adds the ends of an interval, or empty cells.
void add(Cells& cells, const std::optional<Interval>& interval)
{
    cells.push_back(interval ? fmt::format("{}", interval->low) : "");
    cells.push_back(interval ? fmt::format("{}", interval->high) : "");
}

// Returns false if the record's cells must stay empty, because it is the verification of a picture that was not
// rendered.
bool has_cells(const Verification& verification) { return verification.drawn; }
bool has_cells(const auto& /*record*/) { return true; }

// Adds the columns of a record's fields to `names`, and their cells to `cells`. `record`: nullptr for empty cells.
// `timed`: the configuration has a speed.
template <class Record>
void add_fields(Cells& names, Cells& cells, const Record* record, bool timed)
{
    if (record != nullptr && !has_cells(*record)) record = nullptr;
    each_field<Record>([&](const auto& field) {
        using T = Value<Record, decltype(field.member)>;
        const T value = record != nullptr ? T(std::invoke(field.member, *record)) : T();
        const std::string column = field.column;
        if constexpr (std::is_same_v<T, Summary>) {
            names.insert(names.end(), {column + "_s", column + "_low_s", column + "_high_s", column + "_mad_s"});
            cells.push_back(record != nullptr ? cell_of(value.median) : "");
            add(cells, value.interval);
            cells.push_back(record != nullptr ? cell_of(value.mad) : "");
        } else if constexpr (std::is_same_v<T, std::optional<Quotient>>) {
            names.insert(names.end(), {column, column + "_low", column + "_high"});
            cells.push_back(value ? cell_of(value->ratio) : "");
            add(cells, value ? value->interval : std::nullopt);
        } else if constexpr (std::is_same_v<T, std::optional<Figures>>) {
            add_fields<Figures>(names, cells, value ? &*value : nullptr, timed);
        } else if constexpr (Described<T>) {
            add_fields(names, cells, record != nullptr ? &value : nullptr, timed);
        } else if (!column.empty()) {
            names.push_back(column);
            cells.push_back(record == nullptr || (field.rule.timed && !timed) ? "" : cell_of(value));
        }
    });
}

// Returns the name of the configuration's problem. In a sweep each sweep value is a separate problem. The scalar kernel
// also has a sweep value, but it is another application for the same problem.
std::string problem_of(const Row& row)
{
    const bool one_problem = row.sweep_value.empty() || row.application != row.backend;
    return problem_name(row.fractal, row.precision, row.mode, row.setting.width, row.setting.height) +
           (one_problem ? "" : " " + row.sweep_value);
}

}  // namespace

std::string problem_name(const std::string& fractal, Precision precision, Mode mode, int width, int height)
{
    return fmt::format("{} {} {} {}x{}", fractal, name_of(precision), name_of(mode), width, height);
}

std::string csv_cell(const std::string& text)
{
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string made = "\"";
    for (const char c : text) {
        if (c == '"') made += '"';
        made += c;
    }
    return made + "\"";
}

std::string to_csv(const Result& result)
{
    Cells names{"problem", "application", "platform", "fom"};
    Cells none;
    add_fields<Row>(names, none, nullptr, false);
    std::string text = fmt::format("{}\n", fmt::join(names, ","));
    for (const Row& row : result.rows) {
        if (row.setting.width == 0) continue;  // a backend without a device, which has no problem
        Cells cells{csv_cell(problem_of(row)), row.application, csv_cell(row.platform),
                    row.figures ? cell_of(row.figures->pixel_rate) : ""};
        add_fields(none, cells, &row, row.timed());
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

}  // namespace mandelmarch::bench
