// SPDX-License-Identifier: Apache-2.0
// Measures what bench/duel.h judges.
#pragma once

#include <functional>
#include <string>

#include "bench/duel.h"
#include "bench/options.h"

namespace mandelmarch::bench {

struct DuelPlan {
    std::string old_program, new_program;  // files
    double margin = 0.01;
    DuelClock clock = DuelClock::wall;
    int launches = 10;  // of each program
    int rounds = 20;    // pictures of each row in a launch
};

// Runs both programs side by side, launch by launch, on the rows that the options choose, without those that others
// are compared with. In each round every row is drawn once by each program, one right after the other; which row comes
// when, and which program is first, is drawn by lot. So a disturbance that lasts meets both alike. The pictures are
// proven in the first launch, and must be the same ones in the others. A launch in which a program dies is a warning
// and costs its own pairs. `progress` is told the finished share, 0 to 1. Throws InputError where a program is no file
// that can be run, Error where no launch was measured.
Duel run_duel(const DuelPlan& plan, const Options& options, const std::function<void(double)>& progress);

}  // namespace mandelmarch::bench
