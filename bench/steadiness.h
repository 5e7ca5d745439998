// SPDX-License-Identifier: Apache-2.0
// Whether the machine held still while it was measured.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/result.h"
#include "core/base/control_group.h"

namespace mandelmarch::bench {

// Looks at the machine when it is made, and again when it is asked.
class Steadiness {
public:
    Steadiness();

    // A warning for each reason to doubt the times: other load before the start, processors that were busy with other
    // work or taken away by a hypervisor or a quota, backends with unequal numbers of threads, threads bound to cores,
    // clocks that moved or may move, rows whose samples spread.
    std::vector<std::string> warnings(const Result& result) const;

    // The figures that the warnings come from.
    nlohmann::ordered_json during() const;

private:
    struct Look {
        double load = 0;        // average number of running threads over the last minute
        double frequency = 0;   // of the fastest core, MHz; 0: unknown
        double stolen = 0;      // seconds that a hypervisor took from the processors, since boot, all together
        double processors = 0;  // seconds of all processors since boot
        double others = 0;      // seconds of them that other processes used
        Throttling throttling;  // by a quota of control groups
    };
    static Look look();

    Look start_;
};

}  // namespace mandelmarch::bench
