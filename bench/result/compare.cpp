// SPDX-License-Identifier: Apache-2.0
#include "bench/result/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bench/result/differences.h"
#include "bench/result/figures.h"
#include "bench/result/platforms.h"
#include "bench/statistics/table.h"
#include "core/text/error.h"
#include "core/text/text.h"

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

std::vector<double> units_of(const Row& row, bool by_run)
{
    return by_run ? run_medians(row) : group_medians(kernel_times(row));
}

// Returns the reason why a configuration cannot be compared; empty if it can be compared.
std::string lack_of(const Row& row, bool by_run)
{
    if (!row.unavailable.empty()) return "unavailable: " + row.unavailable;
    if (!row.failure.empty()) return row.failure;
    if (row.samples.empty()) return "it was not timed";
    if (!row.timed()) return "its picture was not verified";
    if (!std::ranges::all_of(kernel_times(row), [](double seconds) { return seconds > 0; })) {
        return "a time is not above 0";
    }
    if (by_run && run_medians(row).size() < 2) return "samples of one run only";
    if (!by_run && row.samples.size() < 2 * group_size) {
        return fmt::format("{} samples, fewer than {}", row.samples.size(), 2 * group_size);
    }
    return {};
}

// Compares a configuration of two results. If it can be tested, its verdict is `undecided` until set_verdicts() sets
// it.
Compared compared(const Row& old_row, const Row& new_row, bool by_run)
{
    Compared c{.name = new_row.name()};
    const std::string old_lack = lack_of(old_row, by_run);
    const std::string new_lack = lack_of(new_row, by_run);
    if (!old_lack.empty()) {
        const bool only_new = !old_row.timed() && new_lack.empty();
        c.verdict = only_new ? Verdict::only_new : Verdict::not_compared;
        c.why = "old: " + old_lack;
        return c;
    }
    if (!new_lack.empty()) {
        c.verdict = new_row.failed() ? Verdict::wrong : Verdict::missing;
        c.why = "new: " + new_lack;
        return c;
    }
    const Setting& a = old_row.setting;
    const Setting& b = new_row.setting;
    if (!(a == b)) {
        c.verdict = Verdict::missing;
        c.why = fmt::format("other settings: {}x{} and {}x{}", a.width, a.height, b.width, b.height);
        return c;
    }
    const std::vector<double> old_units = units_of(old_row, by_run);
    const std::vector<double> new_units = units_of(new_row, by_run);
    c.old_units = static_cast<int>(old_units.size());
    c.new_units = static_cast<int>(new_units.size());
    c.difference = difference(old_units, new_units, margin);
    c.verdict = Verdict::undecided;
    return c;
}

// Returns the verdict on a configuration that only the old result has.
Compared missing(const Row& row, const Result& new_result, bool by_run)
{
    Compared c{.name = row.name(), .why = "not in the new result"};
    if (lack_of(row, by_run).empty()) c.verdict = Verdict::missing;
    // A backend without a device appears as one row without a platform.
    for (const Row& other : new_result.rows) {
        if (other.backend == row.backend && other.platform.empty() && !other.unavailable.empty()) {
            c.why = "new: unavailable: " + other.unavailable;
        }
    }
    return c;
}

}  // namespace

ComparedResults compare_results(const Result& old_given, const Result& new_given)
{
    const std::array<Result, 2> given{old_given, new_given};
    const std::vector<Result> apart = disambiguated(given);
    const Result& old_result = apart[0];
    const Result& new_result = apart[1];
    ComparedResults comparison;
    comparison.differences = differences_of(old_result.environment, new_result.environment);
    for (const std::string& warning : old_result.warnings) comparison.warnings.push_back("old result: " + warning);
    for (const std::string& warning : new_result.warnings) comparison.warnings.push_back("new result: " + warning);
    const bool by_run = old_result.runs > 1 && new_result.runs > 1;
    if (!by_run) {
        comparison.warnings.emplace_back(
            "a result has one run only: samples are compared, and differences between runs are unseen "
            "(bench --runs 5)");
    }
    int paired = 0;
    for (const Row& row : new_result.rows) {
        const Row* old_row = partner(old_result, row);
        if (old_row == nullptr) {
            Compared c{.name = row.name(), .why = "not in the old result"};
            if (row.timed()) c.verdict = Verdict::only_new;
            comparison.rows.push_back(std::move(c));
            continue;
        }
        ++paired;
        comparison.rows.push_back(compared(*old_row, row, by_run));
    }
    for (const Row& row : old_result.rows) {
        if (partner(new_result, row) == nullptr) {
            comparison.rows.push_back(missing(row, new_result, by_run));
        }
    }
    if (paired == 0) {
        std::string why = "bench compare: the two results have no row in common";
        for (const std::string& difference : comparison.differences) why += "; " + difference;
        throw InputError(printable(why, longest_note));
    }

    set_verdicts(comparison.rows, margin);
    return comparison;
}

std::string to_console(const ComparedResults& comparison)
{
    return table_of(comparison.rows) + notes("differs: ", comparison.differences) +
           notes("warning: ", comparison.warnings) + summary_of(comparison.rows, margin);
}

}  // namespace mandelmarch::bench
