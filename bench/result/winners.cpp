// SPDX-License-Identifier: Apache-2.0
#include "bench/result/winners.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bench/result/differences.h"
#include "bench/statistics/table.h"

namespace mandelmarch::bench {
namespace {

bool same_ranking(const Row& a, const Row& b)
{
    return a.fractal == b.fractal && a.precision == b.precision && a.mode == b.mode &&
           a.setting.picture() == b.setting.picture();
}

double kernel_median(const Row* row) { return row->figures->kernel.median; }

Compared compared_to(const Row& row, const Row& fastest)
{
    Compared other{.name = row.name(), .verdict = Verdict::no_speed};
    const ValuesByRun by_run = ratios_by_run(row, fastest);
    const std::vector<double> units = by_run.size() == 1 ? group_medians(by_run.begin()->second) : medians_of(by_run);
    other.old_units = other.new_units = static_cast<int>(units.size());
    if (units.size() > 1) {
        other.verdict = Verdict::undecided;
        other.difference = paired_difference(units, margin);
    } else {
        other.why = "too few pictures to be certain";
        other.difference.ratio = kernel_median(&row) / kernel_median(&fastest);
    }
    return other;
}

Ranking ranking_of(std::vector<const Row*> rows)
{
    std::ranges::stable_sort(rows, {}, kernel_median);
    Ranking ranking{.fastest = rows.front(), .others = {}};
    for (std::size_t i = 1; i < rows.size(); ++i) ranking.others.push_back(compared_to(*rows[i], *ranking.fastest));
    return ranking;
}

std::string label_of(const Row& row)
{
    return row.application + (row.device > 0 ? fmt::format(" {}", row.device) : "");
}

std::string line_of(const Result& result, const Ranking& ranking)
{
    const Row& first = *ranking.fastest;
    const std::string name = label_of(first);
    std::string text = fmt::format("{} {} {}: ", first.fractal, name_of(first.precision), name_of(first.mode));
    if (ranking.others.empty()) return text + name + " alone was timed";
    // Name the first configuration that is not slower than the fastest one. If all are slower, name the next fastest.
    const auto slower = [](const Compared& other) { return other.verdict == Verdict::slower; };
    const auto open = std::ranges::find_if_not(ranking.others, slower);
    const bool won = open == ranking.others.end();
    const Compared& next = won ? ranking.others.front() : *open;
    const Difference& d = next.difference;
    text += fmt::format("{} {}, {} times as fast as {}", name, won ? "won" : "leads", digits(d.ratio),
                        label_of(result.row(next.name)));
    if (next.verdict == Verdict::no_speed) return text + ": " + next.why;
    text += " " + interval_text(d.interval);
    if (won) return text + fmt::format(", the next of {}, p {:.2g}", ranking.others.size(), next.p);
    if (next.verdict == Verdict::same) return text + fmt::format(": the same within {:.3g} %", 100 * margin);
    return text + ": undecided, more runs would tell";
}

// Returns a line with the number of processors that other programs and the hypervisor left free; empty if the number is
// unknown.
std::string free_processors(const Result& result)
{
    const auto known = [&](const char* place) {
        const auto value = value_at(result.environment, place);
        return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
    };
    const auto cores = std::min(known("/cpu/cores_usable"), known("/cpu/cores_given"));  // nullopt if one is unknown
    const auto others = known("/during/others_share");
    const auto stolen = known("/during/stolen_share");
    if (!cores || !others || !stolen) return {};
    return fmt::format(
        "{:.1f} of {} processors were free: other programs took {:.0f} % of their time, the hypervisor {:.0f} %{}\n",
        *cores * std::max(0.0, 1 - *others - *stolen), *cores, 100 * *others, 100 * *stolen,
        result.runs > 1 ? ", in the first run" : "");
}

}  // namespace

std::vector<Ranking> rankings_of(const Result& result)
{
    if (result.study != standard_study) return {};
    std::vector<std::vector<const Row*>> groups;
    for (const Row& row : result.rows) {
        if (!row.figures || row.backend == result.reference() || row.figures->kernel.min <= 0) continue;
        const auto same =
            std::ranges::find_if(groups, [&](const auto& rows) { return same_ranking(*rows.front(), row); });
        if (same == groups.end()) {
            groups.push_back({&row});
        } else {
            same->push_back(&row);
        }
    }
    std::vector<Ranking> rankings;
    rankings.reserve(groups.size());
    for (auto& rows : groups) rankings.push_back(ranking_of(std::move(rows)));
    std::vector<Compared> all;
    for (const Ranking& ranking : rankings) {
        all.insert(all.end(), ranking.others.begin(), ranking.others.end());
    }
    set_verdicts(all, margin);
    auto compared = all.begin();
    for (Ranking& ranking : rankings) {
        for (Compared& other : ranking.others) other = *compared++;
    }
    return rankings;
}

std::string winners(const Result& result)
{
    std::string text;
    std::size_t comparisons = 0;
    for (const Ranking& ranking : rankings_of(result)) {
        comparisons += ranking.others.size();
        text += clipped(line_of(result, ranking), console_columns) + "\n";
    }
    if (comparisons > 0) {
        text = fmt::format("Who won, by kernel time; p after Holm's correction for {} comparisons{}\n{}", comparisons,
                           result.runs > 1 ? "" : ", of one run alone", text);
    }
    text += free_processors(result);
    return text.empty() ? text : "\n" + text;
}

}  // namespace mandelmarch::bench
