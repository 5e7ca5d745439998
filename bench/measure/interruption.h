// SPDX-License-Identifier: Apache-2.0
// Ctrl+C during a measurement.
#pragma once

namespace mandelmarch::bench {

// While the only one exists, the first SIGINT or SIGTERM only sets interrupted(). The second one acts as it did before.
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
};

// Returns the signal that was recorded; 0 if there was none.
int interrupted();

}  // namespace mandelmarch::bench
