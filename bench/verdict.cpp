// SPDX-License-Identifier: Apache-2.0
#include "bench/verdict.h"

#include <fmt/format.h>

#include <algorithm>

namespace mandelmarch::bench {

std::string_view name_of(Verdict verdict)
{
    switch (verdict) {
        case Verdict::faster: return "faster";
        case Verdict::slower: return "SLOWER";
        case Verdict::same: return "same";
        case Verdict::undecided: return "undecided";
        case Verdict::broken: return "BROKEN";
        case Verdict::lost: return "LOST";
        case Verdict::added: return "added";
        case Verdict::no_speed: return "no speed";
        default: return "not compared";
    }
}

std::vector<Judgement> judge_all(std::span<const Difference> differences, double within)
{
    std::vector<double> p;
    for (const Difference& difference : differences) p.push_back(difference.p);
    const std::vector<double> adjusted = holm(p);
    std::vector<Judgement> judgements;
    for (std::size_t i = 0; i < adjusted.size(); ++i) {
        const Difference& d = differences[i];
        Judgement judgement{.p = adjusted[i]};
        if (judgement.p < significance) {
            judgement.verdict = d.ratio > 1 ? Verdict::slower : Verdict::faster;
        } else if (d.interval.low >= 1 / (1 + within) && d.interval.high <= 1 + within) {
            judgement.verdict = Verdict::same;
        }
        judgements.push_back(judgement);
    }
    return judgements;
}

std::string summary_of(std::span<const Verdict> verdicts, double within)
{
    std::string text;
    for (const Verdict verdict :
         {Verdict::faster, Verdict::slower, Verdict::broken, Verdict::lost, Verdict::same, Verdict::undecided}) {
        const auto count = std::ranges::count(verdicts, verdict);
        if (count == 0) continue;
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(verdict));
        if (verdict == Verdict::same) text += fmt::format(" within {:.3g} %", 100 * within);
        if (verdict == Verdict::undecided) text += " (more runs would tell: --runs)";
    }
    return text;
}

}  // namespace mandelmarch::bench
