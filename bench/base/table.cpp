// SPDX-License-Identifier: Apache-2.0
#include "bench/base/table.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "core/base/text.h"

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

}  // namespace mandelmarch::bench
