// SPDX-License-Identifier: Apache-2.0
// Runs `bench duel`; bench/contest/duel.h judges the result.
#pragma once

#include <functional>
#include <string>

#include "bench/contest/duel.h"
#include "bench/study/options.h"

namespace mandelmarch::bench {

struct DuelOptions {
    std::string old_program, new_program;  // paths
    Options rows;                          // which configurations take part
    double margin = 0.01;
    DuelClock clock = DuelClock::wall;
    int runs = 10;    // processes of each program
    int rounds = 20;  // pictures of each configuration by each program in a run
};

// Measures the configurations that the options select, without the baselines. For each run both programs are started
// again. In each round every configuration is rendered by one program and directly afterwards by the other. The order
// of the configurations and of the two programs is random, so that a lasting disturbance slows both alike. The pictures
// are verified in the first run and must not change in later runs. If a program dies, the run is left out, with a
// warning. `progress` receives the completed fraction, 0 to 1. Throws InputError if a program is not an executable
// file, Error if no run was measured.
Duel run_duel(const DuelOptions& options, const std::function<void(double)>& progress);

}  // namespace mandelmarch::bench
