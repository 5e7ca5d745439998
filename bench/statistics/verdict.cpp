// SPDX-License-Identifier: Apache-2.0
#include "bench/statistics/verdict.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/statistics/table.h"
#include "core/text/text.h"

namespace mandelmarch::bench {

std::string_view name_of(Verdict verdict)
{
    switch (verdict) {
        case Verdict::faster: return "faster";
        case Verdict::slower: return "SLOWER";
        case Verdict::same: return "same";
        case Verdict::undecided: return "undecided";
        case Verdict::wrong: return "WRONG";
        case Verdict::missing: return "MISSING";
        case Verdict::only_new: return "new";
        case Verdict::no_speed: return "no speed";
        default: return "not compared";
    }
}

void set_verdicts(std::vector<Compared>& rows, double within)
{
    std::vector<Compared*> open;
    std::vector<double> p;
    for (Compared& row : rows) {
        if (row.verdict != Verdict::undecided) continue;
        open.push_back(&row);
        p.push_back(row.difference.p);
    }
    const std::vector<double> adjusted = holm(p);
    for (std::size_t i = 0; i < open.size(); ++i) {
        Compared& row = *open[i];
        const Difference& d = row.difference;
        row.p = adjusted[i];
        if (row.p < significance) {
            row.verdict = d.ratio > 1 ? Verdict::slower : Verdict::faster;
        } else if (d.interval.low >= 1 / (1 + within) && d.interval.high <= 1 + within) {
            row.verdict = Verdict::same;
        }
    }
}

bool regression(const std::vector<Compared>& rows)
{
    return std::ranges::any_of(rows, [](const Compared& row) {
        return row.verdict == Verdict::slower || row.verdict == Verdict::wrong || row.verdict == Verdict::missing;
    });
}

std::string table_of(const std::vector<Compared>& rows)
{
    Table table({"<row", ">new/old", "<95 % interval", ">p, Holm", ">units", "<verdict"});
    for (const Compared& row : rows) {
        if (!row.why.empty()) {
            table.add(printable(row.name), printable(fmt::format("{}: {}", name_of(row.verdict), row.why)));
            continue;
        }
        const Difference& d = row.difference;
        table.add(printable(row.name), fmt::format("{:.3f}", d.ratio),
                  fmt::format("[{:.3f}, {:.3f}]", d.interval.low, d.interval.high), fmt::format("{:.2g}", row.p),
                  row.old_units == row.new_units ? std::to_string(row.new_units)
                                                 : fmt::format("{}, {}", row.old_units, row.new_units),
                  name_of(row.verdict));
    }
    return table.text(console_columns);
}

std::string summary_of(const std::vector<Compared>& rows, double within)
{
    std::string text;
    for (const Verdict verdict :
         {Verdict::faster, Verdict::slower, Verdict::wrong, Verdict::missing, Verdict::same, Verdict::undecided}) {
        const auto count = std::ranges::count(rows, verdict, &Compared::verdict);
        if (count == 0) continue;
        text += fmt::format("{}{} {}", text.empty() ? "verdicts: " : ", ", count, name_of(verdict));
        if (verdict == Verdict::same) text += fmt::format(" within {:.3g} %", 100 * within);
        if (verdict == Verdict::undecided) text += " (more runs would tell: --runs)";
    }
    return text.empty() ? text : text + "\n";
}

}  // namespace mandelmarch::bench
