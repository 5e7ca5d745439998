// SPDX-License-Identifier: Apache-2.0
// A backend to copy: the kernel in a plain loop on one thread. See docs/add-a-backend.md.
#pragma once

#include "core/models/host.h"

namespace mandelmarch::skeleton {

struct Loop : job::HostLoop {
    static constexpr std::string_view title = "skeleton";
    static std::string driver() { return "a plain loop"; }
    static int threads() { return 1; }

    template <class Body>
    static void run(int count, Body body)
    {
        for (int at = 0; at < count; ++at) body(at);
    }
};

}  // namespace mandelmarch::skeleton
