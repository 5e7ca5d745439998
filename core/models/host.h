// SPDX-License-Identifier: Apache-2.0
// A model whose loop runs on this machine's cores. The struct Loop in backends/NAME/loop.h is the whole backend:
//     struct Loop : job::HostLoop {
//         static constexpr std::string_view title = "one plain loop";
//         static std::string driver() { return "C++"; }
//         template <class Body> static void run(int count, Body body) { for (int at = 0; at < count; ++at) body(at); }
//     };
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/os/cores.h"

namespace mandelmarch::job {

using Selection = std::shared_ptr<void>;

// A Loop has a title, as the model's authors spell it; driver(), which starts the model's library and returns its name
// and version; and run(), which calls body(0) to body(count - 1) in any order and waits. The indices stand for pixels
// or tiles, so threads should take several at a time. The other members have defaults.
struct HostLoop {
    // True if limited() limits the number of threads, for the option --threads.
    static constexpr bool sets_threads = false;
    // Returns the number of threads of a loop that is not limited. Called after driver().
    static int threads() { return usable_threads(); }
    // Limits loops to this number of threads until the returned object is destroyed.
    static Selection limited(int) { return nullptr; }
};

}  // namespace mandelmarch::job
