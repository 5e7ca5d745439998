#include "bench/compare.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/console_studies.h"
#include "bench/figures.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

const Row* partner(const Result& result, const Row& row)
{
    const auto found = std::ranges::find_if(result.rows, [&](const Row& other) {
        return other.name() == row.name() &&
               (other.platform == row.platform || other.platform.empty() || row.platform.empty());
    });
    return found == result.rows.end() ? nullptr : &*found;
}

std::vector<double> units_of(const Row& row, bool by_launch)
{
    return by_launch ? launch_medians(row) : kernel_times(row);
}

std::string state_of(const Row& row)
{
    if (!row.unavailable.empty()) return "unavailable: " + row.unavailable;
    return row.failure.empty() ? "no samples" : row.failure;
}

// Everything but the verdict of rows that can be tested.
Compared compared(const Row& old_row, const Row& new_row, bool by_launch)
{
    Compared c{.name = new_row.name(), .platform = new_row.platform};
    if (!old_row.timed() || !new_row.timed()) {
        c.verdict = old_row.timed() && new_row.failed() ? Verdict::broken : Verdict::not_compared;
        c.why = fmt::format("{}: {}", new_row.timed() ? "old" : "new", state_of(new_row.timed() ? old_row : new_row));
        return c;
    }
    const Setting& a = old_row.setting;
    const Setting& b = new_row.setting;
    if (!same_picture(a, b) || a.threads != b.threads || a.pack != b.pack || a.chunk != b.chunk ||
        a.frames != b.frames || a.without != b.without) {
        c.why = fmt::format("other settings: {}x{} and {}x{}", a.width, a.height, b.width, b.height);
        return c;
    }
    const std::vector<double> old_units = units_of(old_row, by_launch);
    const std::vector<double> new_units = units_of(new_row, by_launch);
    c.old_units = static_cast<int>(old_units.size());
    c.new_units = static_cast<int>(new_units.size());
    const auto positive = [](double value) { return value > 0; };
    if (c.old_units < 2 || c.new_units < 2 || !std::ranges::all_of(old_units, positive) ||
        !std::ranges::all_of(new_units, positive)) {
        c.why = "too few samples";
        return c;
    }
    c.difference = difference(old_units, new_units, margin);
    c.verdict = Verdict::no_difference;
    return c;
}

}  // namespace

std::string_view name_of(Verdict verdict)
{
    switch (verdict) {
        case Verdict::faster: return "faster";
        case Verdict::slower: return "SLOWER";
        case Verdict::no_difference: return "no difference";
        case Verdict::broken: return "BROKEN";
        default: return "not compared";
    }
}

bool ComparedResults::regression() const
{
    return std::ranges::any_of(
        rows, [](const Compared& row) { return row.verdict == Verdict::slower || row.verdict == Verdict::broken; });
}

ComparedResults compare_results(const Result& old_result, const Result& new_result)
{
    ComparedResults comparison;
    const bool by_launch = old_result.launches > 1 && new_result.launches > 1;
    if (!by_launch) {
        comparison.warnings.emplace_back(
            "a result has one launch only: samples are compared, and differences between launches are unseen "
            "(bench --launches 5)");
    }
    int paired = 0;
    for (const Row& row : new_result.rows) {
        const Row* old_row = partner(old_result, row);
        if (old_row == nullptr) {
            comparison.rows.push_back({.name = row.name(), .platform = row.platform, .why = "not in the old result"});
            continue;
        }
        ++paired;
        comparison.rows.push_back(compared(*old_row, row, by_launch));
    }
    for (const Row& row : old_result.rows) {
        if (partner(new_result, row) == nullptr) {
            comparison.rows.push_back({.name = row.name(), .platform = row.platform, .why = "not in the new result"});
        }
    }
    if (paired == 0) throw InputError("bench compare: the two results have no row in common");

    std::vector<Compared*> tested;
    std::vector<double> p;
    for (Compared& row : comparison.rows) {
        if (row.verdict != Verdict::no_difference) continue;
        tested.push_back(&row);
        p.push_back(row.difference.p);
    }
    const std::vector<double> adjusted = holm(p);
    for (std::size_t i = 0; i < tested.size(); ++i) {
        tested[i]->p = adjusted[i];
        if (adjusted[i] >= significance) continue;
        tested[i]->verdict = tested[i]->difference.ratio > 1 ? Verdict::slower : Verdict::faster;
    }
    return comparison;
}

std::string to_console(const ComparedResults& comparison)
{
    std::string text = fmt::format("{:<48} {:>7} {:<18} {:>8} {:>7}  {}\n", "row", "new/old", "95 % interval",
                                   "p, Holm", "units", "verdict");
    for (const Compared& row : comparison.rows) {
        if (row.verdict == Verdict::broken || row.verdict == Verdict::not_compared) {
            text += clipped(fmt::format("{:<48} {}: {}", row.name, name_of(row.verdict), row.why), 120) + "\n";
            continue;
        }
        const Difference& d = row.difference;
        text += fmt::format("{:<48} {:>7.3f} {:<18} {:>8.2g} {:>7}  {}\n", row.name, d.ratio,
                            fmt::format("[{:.3f}, {:.3f}]", d.interval.low, d.interval.high), row.p,
                            fmt::format("{}, {}", row.old_units, row.new_units), name_of(row.verdict));
    }
    for (const std::string& warning : comparison.warnings) text += "warning: " + warning + "\n";
    return text;
}

}  // namespace mandelmarch::bench
