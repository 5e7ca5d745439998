// SPDX-License-Identifier: Apache-2.0
#include "bench/print/demo_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/os/cores.h"
#include "core/os/cpu.h"

namespace mandelmarch::bench {
namespace {

// Returns the distinct values of `member`, in the order in which they first occur in the rows.
std::vector<std::string> different(const std::vector<Row>& rows, std::string Row::*member)
{
    std::vector<std::string> values;
    for (const Row& row : rows) {
        if (std::ranges::find(values, row.*member) == values.end()) values.push_back(row.*member);
    }
    return values;
}

std::string line(const Row& row)
{
    std::string text = fmt::format("{:<11} {:<13} ", row.fractal, row.application);
    if (!row.device_name.empty()) text += fmt::format("{:<9} {:<5} ", name_of(row.precision), name_of(row.mode));
    if (row.timed()) {
        text += fmt::format("{:9.1f} {:>9.2f}   ", 1e3 * row.figures->wall.median, speed_up(row));
    } else {
        text += row.failed() ? "FAILED: " : "unavailable: ";
    }
    return text + remark(row) + "\n";
}

}  // namespace

std::vector<Row> demo_rows(const Result& result)
{
    std::vector<Row> ordered;
    for (const std::string& fractal : different(result.rows, &Row::fractal)) {
        if (fractal == "all") continue;
        for (const std::string& backend : different(result.rows, &Row::backend)) {
            const auto first = std::ssize(ordered);
            for (Row row : result.rows) {
                if (row.backend != backend || (row.fractal != fractal && row.fractal != "all")) continue;
                row.fractal = fractal;
                ordered.push_back(std::move(row));
            }
            std::ranges::stable_sort(ordered.begin() + first, ordered.end(), {}, &Row::mode);
        }
    }
    return ordered;
}

const std::string& remark(const Row& row)
{
    if (!row.unavailable.empty()) return row.unavailable;
    return row.failure.empty() ? row.verification.text : row.failure;
}

double speed_up(const Row& row) { return row.figures && row.figures->speed_up ? row.figures->speed_up->ratio : 0; }

std::string demo_table(const Result& result)
{
    const std::vector<Row> rows = demo_rows(result);
    std::string text = fmt::format("{}, {} threads\n", cpu_name(), usable_threads());
    if (!rows.empty()) {
        text += fmt::format("{} x {} pixels; medians; speed-up over {}, exact; {}-scalar: the kernel as scalar C++\n",
                            rows.front().setting.width, rows.front().setting.height, result.reference(), result.host());
    }
    text += fmt::format("{:<11} {:<13} {:<9} {:<5} {:>9} {:>9}   {}\n", "fractal", "backend", "precision", "mode",
                        "wall ms", "speed-up", "picture");
    for (const Row& row : rows) text += line(row);
    return text;
}

}  // namespace mandelmarch::bench
