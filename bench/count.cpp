// SPDX-License-Identifier: Apache-2.0
#include "bench/counting.h"

namespace mandelmarch::bench {

Operations operator+(Operations a, Operations b)
{
    return {a.sums + b.sums, a.products + b.products, a.quotients + b.quotients, a.roots + b.roots};
}

Operations operator-(Operations a, Operations b)
{
    return {a.sums - b.sums, a.products - b.products, a.quotients - b.quotients, a.roots - b.roots};
}

std::string_view name_of(Stage stage)
{
    constexpr std::array<std::string_view, stage_count> names{"begin", "march", "refine", "normal", "shade"};
    return names.at(static_cast<std::size_t>(stage));
}

Operations Count::all() const
{
    Operations sum;
    for (const Operations& stage : stages) sum = sum + stage;
    return sum;
}

double Count::per_iteration() const
{
    return work.iterations == 0 ? 0 : static_cast<double>(all().total()) / static_cast<double>(work.iterations);
}

}  // namespace mandelmarch::bench
