// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text/error.h"

namespace mandelmarch {

double faults(const Audit& audit)
{
    double sum = 0;
    for (const Row& row : audit.rows) {
        if (row.kept()) continue;
        const double by = std::abs(row.value - row.bar) / std::max(std::abs(row.bar), 1.0);
        sum += (row.promise ? broken_promise : 1) * (1 + std::min(by, 5.0));
    }
    return sum;
}

bool misses_only(const Audit& audit, std::string_view item)
{
    return audit.bars_missed() == 1 &&
           std::ranges::all_of(audit.rows, [item](const Row& row) { return row.kept() || row.name == item; });
}

std::string missed_items(const Audit& audit, bool promises)
{
    std::string items;
    for (const Row& row : audit.rows) {
        if (row.kept() || (promises && !row.promise)) continue;
        items += fmt::format("{}{} ({:.4g} {} {:.4g}{}{})", items.empty() ? "" : ", ", row.name, row.value,
                             row.at_most ? ">" : "<", row.bar, row.unit.empty() ? "" : " ", row.unit);
    }
    return items.empty() ? "nothing" : items;
}

void Best::take(Path other, const Audit& audit)
{
    const double theirs = mandelmarch::faults(audit);
    if (theirs < faults) *this = {std::move(other), theirs, missed_items(audit, true)};
}

void check_found(const Best& best, const std::string& missed_place, std::uint64_t seed, int frames, std::size_t gates)
{
    if (best.path.frames.empty()) {
        if (!missed_place.empty()) throw InputError(missed_place);
        throw Error(
            fmt::format("plan: no tour of seed {} is long enough for {} frames among {} gates, expected fewer "
                        "frames, another seed or a shape with more gates",
                        seed, frames, gates));
    }
    if (best.faults >= broken_promise) {
        throw Error(
            fmt::format("plan: no tour of seed {} among {} gates keeps every promise, the best breaks: {}; "
                        "expected another seed or a shape with more gates",
                        seed, gates, best.promises));
    }
}

}  // namespace mandelmarch
