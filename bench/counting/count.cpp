// SPDX-License-Identifier: Apache-2.0
#include "bench/counting/counting.h"

namespace mandelmarch::bench {

Operations operator+(Operations a, Operations b)
{
    return {a.additions + b.additions, a.multiplications + b.multiplications, a.divisions + b.divisions,
            a.square_roots + b.square_roots};
}

Operations operator-(Operations a, Operations b)
{
    return {a.additions - b.additions, a.multiplications - b.multiplications, a.divisions - b.divisions,
            a.square_roots - b.square_roots};
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
