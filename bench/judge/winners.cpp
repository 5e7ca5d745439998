// SPDX-License-Identifier: Apache-2.0
#include "bench/judge/winners.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bench/base/table.h"
#include "bench/judge/differences.h"

namespace mandelmarch::bench {
namespace {

bool same_contest(const Row& a, const Row& b)
{
    return a.fractal == b.fractal && a.precision == b.precision && a.mode == b.mode &&
           a.setting.picture() == b.setting.picture();
}

double kernel_median(const Row* row) { return row->figures->kernel.median; }

Judged rival_of(const Row& row, const Row& fastest)
{
    Judged rival{.name = row.name(), .verdict = Verdict::no_speed};
    const ValuesByRun by_run = ratios_by_run(row, fastest);
    const std::vector<double> units = by_run.size() == 1 ? group_medians(by_run.begin()->second) : medians_of(by_run);
    rival.old_units = rival.new_units = static_cast<int>(units.size());
    if (units.size() > 1) {
        rival.verdict = Verdict::undecided;
        rival.difference = paired_difference(units, margin);
    } else {
        rival.why = "too few pictures to be certain";
        rival.difference.ratio = kernel_median(&row) / kernel_median(&fastest);
    }
    return rival;
}

Contest contest_of(std::vector<const Row*> rows)
{
    std::ranges::stable_sort(rows, {}, kernel_median);
    Contest contest{.fastest = rows.front(), .rivals = {}};
    for (std::size_t i = 1; i < rows.size(); ++i) contest.rivals.push_back(rival_of(*rows[i], *contest.fastest));
    return contest;
}

std::string label_of(const Row& row)
{
    return row.application + (row.device > 0 ? fmt::format(" {}", row.device) : "");
}

std::string line_of(const Result& result, const Contest& contest)
{
    const Row& first = *contest.fastest;
    const std::string name = label_of(first);
    std::string text = fmt::format("{} {} {}: ", first.fractal, name_of(first.precision), name_of(first.mode));
    if (contest.rivals.empty()) return text + name + " alone was timed";
    // Name the first rival that is not slower than the fastest configuration or, if all are slower, the first of them.
    const auto slower = [](const Judged& rival) { return rival.verdict == Verdict::slower; };
    const auto open = std::ranges::find_if_not(contest.rivals, slower);
    const bool won = open == contest.rivals.end();
    const Judged& next = won ? contest.rivals.front() : *open;
    const Difference& d = next.difference;
    text += fmt::format("{} {}, {} times as fast as {}", name, won ? "won" : "leads", digits(d.ratio),
                        label_of(result.row(next.name)));
    if (next.verdict == Verdict::no_speed) return text + ": " + next.why;
    text += " " + interval_text(d.interval);
    if (won) return text + fmt::format(", the next of {}, p {:.2g}", contest.rivals.size(), next.p);
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

std::vector<Contest> contests_of(const Result& result)
{
    if (result.study != standard_study) return {};
    std::vector<std::vector<const Row*>> groups;
    for (const Row& row : result.rows) {
        if (!row.figures || row.backend == result.reference() || row.figures->kernel.min <= 0) continue;
        const auto same =
            std::ranges::find_if(groups, [&](const auto& rows) { return same_contest(*rows.front(), row); });
        if (same == groups.end()) {
            groups.push_back({&row});
        } else {
            same->push_back(&row);
        }
    }
    std::vector<Contest> contests;
    contests.reserve(groups.size());
    for (auto& rows : groups) contests.push_back(contest_of(std::move(rows)));
    std::vector<Judged> all;
    for (const Contest& contest : contests) {
        all.insert(all.end(), contest.rivals.begin(), contest.rivals.end());
    }
    judge(all, margin);
    auto judged = all.begin();
    for (Contest& contest : contests) {
        for (Judged& rival : contest.rivals) rival = *judged++;
    }
    return contests;
}

std::string winners(const Result& result)
{
    std::string text;
    std::size_t comparisons = 0;
    for (const Contest& contest : contests_of(result)) {
        comparisons += contest.rivals.size();
        text += clipped(line_of(result, contest), console_columns) + "\n";
    }
    if (comparisons > 0) {
        text = fmt::format("Who won, by kernel time; p after Holm's correction for {} comparisons{}\n{}", comparisons,
                           result.runs > 1 ? "" : ", of one run alone", text);
    }
    text += free_processors(result);
    return text.empty() ? text : "\n" + text;
}

}  // namespace mandelmarch::bench
