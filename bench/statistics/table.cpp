// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "core/text/text.h"

namespace mandelmarch::bench {

std::string digits(double value)
{
    const double size = std::abs(value);
    if (size == 0) return "0";
    if (size >= 1e6) return fmt::format("{:.2e}", value);
    const int decimals = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : size >= 1 ? 3 : 4;
    return fmt::format("{:.{}f}", value, decimals);
}

std::string interval_text(const Interval& interval, double unit)
{
    return fmt::format("[{}, {}]", digits(unit * interval.low), digits(unit * interval.high));
}

std::string interval_text(const std::optional<Interval>& interval, int count, double unit)
{
    return interval ? interval_text(*interval, unit) : fmt::format("n = {}", count);
}

std::string notes(const std::string& start, const std::vector<std::string>& texts)
{
    std::string lines;
    for (const std::string& text : texts) lines += printable(start + text, longest_note) + "\n";
    return lines;
}

std::string clipped(const std::string& line, std::size_t most)
{
    return line.size() <= most ? line : fmt::format("{}...", std::string_view(line).substr(0, most - 3));
}

std::string Table::text(std::size_t most) const
{
    if (rows_.empty()) return {};
    std::vector<std::size_t> widths(heads_.size());
    for (const auto& cells : rows_) {
        const std::size_t columns = cells.size() == heads_.size() ? cells.size() : cells.size() - 1;
        for (std::size_t i = 0; i < columns; ++i) widths[i] = std::max(widths[i], cells[i].size());
    }
    std::vector<std::string> titles;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
        titles.push_back(widths[i] > 0 ? heads_[i].substr(1) : "");
        widths[i] = std::max(widths[i], titles.back().size());
    }
    std::string text;
    const auto add_line = [&](const std::vector<std::string>& cells) {
        std::string line;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const bool last = i + 1 == cells.size();
            if (widths[i] == 0 && !last) continue;
            const bool spans = last && cells.size() < heads_.size();
            const bool left = heads_[i].front() == '<' || spans;
            line += left ? fmt::format("{:<{}} ", cells[i], widths[i]) : fmt::format("{:>{}} ", cells[i], widths[i]);
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += clipped(line, most) + "\n";
    };
    add_line(titles);
    for (const auto& cells : rows_) add_line(cells);
    return text;
}

}  // namespace mandelmarch::bench
