// SPDX-License-Identifier: Apache-2.0
// Checks whether the machine was undisturbed during the measurement.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/result/result.h"
#include "core/os/control_group.h"

namespace mandelmarch::bench {

// Records the machine's state on construction. Each call compares that state with the current one.
class Steadiness {
public:
    Steadiness();

    // Returns a warning for each reason to doubt the times:
    //   - other load before the start
    //   - processors that were busy with other work, or taken away by a hypervisor or a quota
    //   - backends with unequal numbers of threads, or threads bound to cores
    //   - clock frequencies that changed or may change
    //   - configurations whose samples vary much
    std::vector<std::string> warnings(const Result& result) const;

    // Returns the measured quantities that warnings are based on.
    nlohmann::ordered_json during() const;

private:
    struct Snapshot {
        double load = 0;        // average number of running threads over the last minute
        double frequency = 0;   // of the fastest core, MHz; 0: unknown
        double stolen = 0;      // seconds since boot that a hypervisor took from all processors together
        double processors = 0;  // seconds since boot, summed over all processors
        double others = 0;      // the part of `processors` that other processes used
        Throttling throttling;  // throttling by a quota of control groups
    };
    static Snapshot look();

    Snapshot start_;
};

}  // namespace mandelmarch::bench
