// SPDX-License-Identifier: Apache-2.0
// The stdpar backend: the kernel in std::for_each of C++ standard parallelism, on all cores.
#pragma once

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/version.h>

#include <algorithm>
#include <execution>
#include <vector>

#include "core/models/host.h"

namespace mandelmarch::stdpar {

struct Loop : job::HostLoop {
    static constexpr std::string_view title = "C++ standard parallelism";
    static std::string driver() { return fmt::format("TBB {}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR); }

    // By default TBB starts at most one thread for each core that it detects.
    static int threads() { return std::min(usable_threads(), tbb::info::default_concurrency()); }

    // Sets the number of threads with TBB, because the C++ standard has no function for it.
    static constexpr bool sets_threads = true;
    static job::Selection limited(int threads)
    {
        return std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                     static_cast<std::size_t>(threads));
    }

    // Iterates over an array of indices in memory, because libstdc++ treats iterators of std::views::iota as input
    // iterators and runs over those on one thread.
    template <class Body>
    static void run(int count, Body body)
    {
        constexpr int together = 32;
        std::vector<int> firsts;
        for (int first = 0; first < count; first += together) firsts.push_back(first);
        std::for_each(std::execution::par_unseq, firsts.begin(), firsts.end(), [=](int first) {
            for (int at = first; at < std::min(first + together, count); ++at) body(at);
        });
    }
};

}  // namespace mandelmarch::stdpar
