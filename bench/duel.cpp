// SPDX-License-Identifier: Apache-2.0
#include "bench/duel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/console_studies.h"
#include "bench/differences.h"
#include "core/base/text.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

// Returns for each run the median of its pairs' ratios.
std::map<int, double> ratios_of(const DuelRow& row)
{
    ValuesByRun runs;
    for (const DuelPair& pair : row.pairs) runs[pair.run].push_back(pair.new_seconds / pair.old_seconds);
    std::map<int, double> ratios;
    for (auto& [run, values] : runs) ratios[run] = median(std::move(values));
    return ratios;
}

// Returns why the configuration cannot be tested; empty if it can.
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
    for (const auto& [run, ratio] : by_run) ratios.push_back(ratio);
    Judged j{.name = std::move(name), .verdict = Verdict::undecided};
    j.difference = paired_difference(ratios, margin);
    j.runs = static_cast<int>(ratios.size());
    return j;
}

Judged judged(const DuelRow& row, double margin)
{
    Judged j{.name = row.name};
    if (!row.old_failure.empty()) {
        j.why = "old: " + row.old_failure;
    } else if (!row.new_failure.empty()) {
        j.verdict = Verdict::broken;
        j.why = "new: " + row.new_failure;
    } else if (j.why = lack_of(row); j.why.empty()) {
        j = tested(row.name, ratios_of(row), margin);
    }
    j.pairs = static_cast<int>(row.pairs.size());
    j.same_picture = row.same_picture;
    return j;
}

// Returns the geometric mean of the ratios of all tested configurations, for each run in which all of them have one.
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

std::vector<Judged> judge(const Duel& duel)
{
    std::vector<Judged> all;
    for (const DuelRow& row : duel.rows) all.push_back(judged(row, duel.margin));
    if (std::ranges::count(all, Verdict::undecided, &Judged::verdict) > 1) {
        const std::map<int, double> means = mean_of_rows(duel, all);
        if (means.size() > 1) all.push_back(tested(std::string(all_rows), means, duel.margin));
    }
    std::vector<Judged*> open;
    std::vector<Difference> differences;
    for (Judged& row : all) {
        if (row.verdict != Verdict::undecided) continue;
        open.push_back(&row);
        differences.push_back(row.difference);
    }
    const std::vector<Judgement> judgements = judge_all(differences, duel.margin);
    for (std::size_t i = 0; i < open.size(); ++i) {
        open[i]->verdict = judgements[i].verdict;
        open[i]->p = judgements[i].p;
    }
    return all;
}

bool regression(const std::vector<Judged>& judged)
{
    return std::ranges::any_of(
        judged, [](const Judged& row) { return row.verdict == Verdict::slower || row.verdict == Verdict::broken; });
}

std::string to_console(const Duel& duel, const std::vector<Judged>& judged)
{
    std::string text = fmt::format("{:<44} {:>7} {:<18} {:>8} {:>8}  {}\n", "row", "new/old", "95 % interval",
                                   "p, Holm", "runs", "verdict");
    const auto line = [&](const std::string& whole) { text += clipped(printable(whole), console_columns) + "\n"; };
    for (const Judged& row : judged) {
        if (!row.why.empty()) {
            line(fmt::format("{:<44} {}: {}", row.name, name_of(row.verdict), row.why));
            continue;
        }
        const Difference& d = row.difference;
        line(fmt::format("{:<44} {:>7.4f} {:<18} {:>8.2g} {:>8}  {}{}", row.name, d.ratio,
                         fmt::format("[{:.4f}, {:.4f}]", d.interval.low, d.interval.high), row.p, row.runs,
                         name_of(row.verdict), row.same_picture ? "" : ", another picture"));
    }
    text += fmt::format("{} runs of each program, {} pictures of each row in each, {}\n", duel.runs,
                        duel.rounds, duel.clock == DuelClock::wall ? "kernel time" : "processor time");
    for (const std::string& difference : differences_of(duel.old_side.environment, duel.new_side.environment)) {
        text += printable("differs: " + difference, longest_note) + "\n";
    }
    for (const std::string& warning : duel.warnings) text += printable("warning: " + warning, longest_note) + "\n";
    std::vector<Verdict> verdicts;
    for (const Judged& row : judged) {
        if (row.name != all_rows) verdicts.push_back(row.verdict);
    }
    const std::string summary = summary_of(verdicts, duel.margin);
    if (!summary.empty()) text += fmt::format("verdicts: {}\n", summary);
    return text;
}

nlohmann::ordered_json json_of(const Duel& duel, const std::vector<Judged>& judged)
{
    const auto side = [](const DuelSide& s) { return Json{{"program", s.program}, {"environment", s.environment}}; };
    Json verdicts = Json::array();
    for (const Judged& row : judged) {
        const Difference& d = row.difference;
        const bool told = row.why.empty();
        verdicts.push_back({{"name", row.name},
                            {"verdict", name_of(row.verdict)},
                            {"why", told ? Json() : Json(row.why)},
                            {"ratio", told ? Json(d.ratio) : Json()},
                            {"interval", told ? Json{d.interval.low, d.interval.high} : Json()},
                            {"p", told ? Json(row.p) : Json()},
                            {"runs", row.runs}});
    }
    Json rows = Json::array();
    for (const DuelRow& row : duel.rows) {
        Json pairs = Json::array();
        for (const DuelPair& pair : row.pairs) {
            pairs.push_back(
                {{"run", pair.run}, {"round", pair.round}, {"old", pair.old_seconds}, {"new", pair.new_seconds}});
        }
        rows.push_back({{"name", row.name},
                        {"old_failure", row.old_failure.empty() ? Json() : Json(row.old_failure)},
                        {"new_failure", row.new_failure.empty() ? Json() : Json(row.new_failure)},
                        {"same_picture", row.same_picture},
                        {"pairs", pairs}});
    }
    return {{"schema", "mandelmarch-duel"},
            {"version", 1},
            {"old", side(duel.old_side)},
            {"new", side(duel.new_side)},
            {"clock", name_of(duel.clock)},
            {"margin", duel.margin},
            {"runs", duel.runs},
            {"rounds", duel.rounds},
            {"warnings", duel.warnings},
            {"verdicts", verdicts},
            {"rows", rows}};
}

}  // namespace mandelmarch::bench
