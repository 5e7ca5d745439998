// SPDX-License-Identifier: Apache-2.0
// Parallel loops whose results do not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace mandelmarch {

// Calls body(first, last) for disjoint parts that cover [0, count), on up to `threads` threads (0: as many as the
// process may use). The length of every part but the last is a multiple of `grain`. The output of `body` for an index
// must not depend on the part that contains the index. Rethrows an exception of `body`. A loop inside `body` runs on
// one thread.
void parallel(std::size_t count, std::size_t grain, int threads,
              const std::function<void(std::size_t first, std::size_t last)>& body);

}  // namespace mandelmarch
