// SPDX-License-Identifier: Apache-2.0
// Loops over several threads, with results that do not depend on how many there are.
#pragma once

#include <cstddef>
#include <functional>

namespace mandelmarch {

// Calls body(first, last) for disjoint parts that cover [0, count), each a multiple of `grain` long but the last, on up
// to `threads` threads. What a call writes must depend on its indices only.
void parallel(std::size_t count, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t last)>& body);

}  // namespace mandelmarch
