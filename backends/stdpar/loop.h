// SPDX-License-Identifier: Apache-2.0
// The loop of C++ standard parallelism.
#pragma once

#include <algorithm>
#include <execution>
#include <ranges>

namespace mandelmarch::stdpar {

template <class Body>
void loop(int count, Body body)
{
    const auto places = std::views::iota(0, count);
    std::for_each(std::execution::par_unseq, places.begin(), places.end(), body);
}

}  // namespace mandelmarch::stdpar
