// SPDX-License-Identifier: Apache-2.0
#include "bench/contest/duel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/base/table.h"
#include "bench/judge/differences.h"

namespace mandelmarch::bench {
namespace {

// Returns, for each run, the median of its pairs' ratios.
std::map<int, double> ratios_of(const DuelRow& row)
{
    ValuesByRun runs;
    for (const DuelPair& pair : row.pairs) runs[pair.run].push_back(pair.new_seconds / pair.old_seconds);
    std::map<int, double> ratios;
    for (auto& [run, values] : runs) ratios[run] = median(std::move(values));
    return ratios;
}

// Returns the reason why the configuration cannot be tested; empty if it can be tested.
std::string lack_of(const DuelRow& row)
{
    const auto positive = [](const DuelPair& pair) { return pair.old_seconds > 0 && pair.new_seconds > 0; };
    if (!std::ranges::all_of(row.pairs, positive)) return "a time is not above 0";
    if (ratios_of(row).size() < 2) return "fewer than two runs";
    return {};
}

Judged tested(std::string name, const std::map<int, double>& by_run, double margin)
{
    std::vector<double> ratios;
    ratios.reserve(by_run.size());
    for (const auto& [run, ratio] : by_run) ratios.push_back(ratio);
    Judged j{.name = std::move(name), .verdict = Verdict::undecided};
    j.difference = paired_difference(ratios, margin);
    j.old_units = j.new_units = static_cast<int>(ratios.size());
    return j;
}

Judged tested(const DuelRow& row, double margin)
{
    Judged j{.name = row.name, .verdict = Verdict::no_speed};
    if (!row.old_failure.empty()) {
        j.why = "old: " + row.old_failure;
    } else if (!row.new_failure.empty()) {
        j.verdict = Verdict::wrong;
        j.why = "new: " + row.new_failure;
    } else if (j.why = lack_of(row); j.why.empty()) {
        j = tested(row.name, ratios_of(row), margin);
    }
    j.same_picture = row.same_picture;
    return j;
}

// Returns the geometric mean of the ratios of all tested configurations, for each run in which each of them has a
// ratio.
std::map<int, double> mean_of_rows(const Duel& duel, const std::vector<Judged>& rows)
{
    std::map<int, double> logarithms;
    std::map<int, int> counts;
    int tested_rows = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i].verdict != Verdict::undecided) continue;
        ++tested_rows;
        for (const auto& [run, ratio] : ratios_of(duel.rows[i])) {
            logarithms[run] += std::log(ratio);
            ++counts[run];
        }
    }
    std::map<int, double> means;
    for (const auto& [run, sum] : logarithms) {
        if (counts[run] == tested_rows) means[run] = std::exp(sum / tested_rows);
    }
    return means;
}

}  // namespace

std::string_view name_of(DuelClock clock) { return clock == DuelClock::wall ? "wall" : "processor"; }

Duel judged(Duel duel)
{
    std::vector<Judged>& all = duel.verdicts;
    all.clear();
    for (const DuelRow& row : duel.rows) all.push_back(tested(row, duel.margin));
    if (std::ranges::count(all, Verdict::undecided, &Judged::verdict) > 1) {
        const std::map<int, double> means = mean_of_rows(duel, all);
        if (means.size() > 1) all.push_back(tested(std::string(all_rows), means, duel.margin));
    }
    judge(all, duel.margin);
    return duel;
}

std::string to_console(const Duel& duel)
{
    std::string text = table_of(duel.verdicts, 4);
    text += fmt::format("{} runs of each program, {} pictures of each row in each, {}\n", duel.runs, duel.rounds,
                        duel.clock == DuelClock::wall ? "kernel time" : "processor time");
    text += notes("differs: ", differences_of(duel.old_side.environment, duel.new_side.environment));
    text += notes("warning: ", duel.warnings);
    std::vector<Judged> rows = duel.verdicts;
    std::erase_if(rows, [](const Judged& row) { return row.name == all_rows; });
    return text + summary_of(rows, duel.margin);
}

}  // namespace mandelmarch::bench
