// SPDX-License-Identifier: Apache-2.0
// A parallel loop with C++ standard parallelism.
#pragma once

#include <algorithm>
#include <execution>
#include <vector>

namespace mandelmarch::stdpar {

// Calls body(0) to body(count - 1) in parallel. Iterates over an array of indices in memory, because libstdc++ treats
// iterators of std::views::iota as input iterators and runs over those on one thread.
template <class Body>
void loop(int count, Body body)
{
    constexpr int together = 32;
    std::vector<int> firsts;
    for (int first = 0; first < count; first += together) firsts.push_back(first);
    std::for_each(std::execution::par_unseq, firsts.begin(), firsts.end(), [=](int first) {
        for (int at = first; at < std::min(first + together, count); ++at) body(at);
    });
}

}  // namespace mandelmarch::stdpar
