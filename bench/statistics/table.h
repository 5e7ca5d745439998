// SPDX-License-Identifier: Apache-2.0
// Numbers and lines of tables for the console.
//     Table table({"<backend", ">seconds"});
//     table.add("openmp", digits(0.1234));
//     print(table.text(console_columns));
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/statistics/statistics.h"

namespace mandelmarch::bench {

inline constexpr std::size_t console_columns = 120;  // maximum characters of a table's line
inline constexpr std::size_t longest_note = 1000;    // maximum bytes of a warning

// Formats a value with about four significant digits.
std::string digits(double value);

// Multiplies both ends of an interval by `unit` and formats them: "[12.30, 12.45]".
std::string interval_text(const Interval& interval, double unit = 1);

// Formats an interval as above or, if there is none, the number of values: "n = 3".
std::string interval_text(const std::optional<Interval>& interval, int count, double unit = 1);

// Returns a line for each text: `start`, then the text. Replaces unprintable characters and truncates long lines.
std::string notes(const std::string& start, const std::vector<std::string>& texts);

// Truncates a line to `most` characters.
std::string clipped(const std::string& line, std::size_t most);

// A table for the console: a line of heads and a line for each row. A column is as wide as its widest cell;
// one whose cells are all empty is left out.
class Table {
public:
    // `heads`: the columns' titles, each after < or >, the side to which the column is aligned.
    explicit Table(std::vector<std::string> heads) : heads_(std::move(heads)) {}

    // Adds a row. If it has fewer cells than the table has columns, its last cell may be of any length.
    template <class... Cells>
    void add(const Cells&... cells)
    {
        rows_.push_back({fmt::format("{}", cells)...});
    }
    void add_cells(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

    // Returns the table, in lines of at most `most` characters; an empty text if it has no rows.
    std::string text(std::size_t most = std::string::npos) const;

private:
    std::vector<std::string> heads_;
    std::vector<std::vector<std::string>> rows_;
};

}  // namespace mandelmarch::bench
