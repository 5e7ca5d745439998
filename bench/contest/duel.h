// SPDX-License-Identifier: Apache-2.0
// bench duel: compares two builds of bench, whose pictures are timed in alternation.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/base/statistics.h"
#include "bench/judge/verdict.h"
#include "bench/study/options.h"

namespace mandelmarch::bench {

// The clock by which a duel compares pictures.
enum class DuelClock {
    wall,      // wall time of the kernel, as in bench's tables
    processor  // processor time of all threads of the program; load from other programs does not count
};
std::string_view name_of(DuelClock clock);

// Times of a pair of pictures of a configuration. The old program renders one picture and the new program the other,
// one directly after the other and in random order.
struct DuelPair {
    int run = 0, round = 0;
    double old_seconds = 0, new_seconds = 0;
};

struct DuelRow {
    std::string name;
    std::vector<DuelPair> pairs{};
    std::string old_failure{}, new_failure{};  // why the old or new program has no speed; else empty
    bool same_picture = true;                  // the programs' pictures are equal byte for byte
};

struct DuelSide {
    std::string program;
    nlohmann::ordered_json environment = nlohmann::ordered_json::object();
};

struct Duel {
    DuelSide old_side{}, new_side{};
    DuelClock clock = DuelClock::wall;
    double margin = 0.01;  // times with a ratio from 1 / (1 + margin) to 1 + margin count as the same
    int runs = 0;          // complete runs of each program
    int rounds = 0;        // pairs of pictures of each configuration in a run
    std::vector<std::string> warnings{};
    std::vector<DuelRow> rows{};
    std::vector<Judged> verdicts{};  // set by judged()
};

inline constexpr std::string_view all_rows = "all rows";

// Sets the verdicts (bench/judge/verdict.h): one for each configuration and, if several were tested, a last one for the
// geometric mean of their ratios. Each run contributes one value, the median of its pairs' ratios. Student's t-test on
// the logarithms of these values tests whether the true ratio lies beyond the margin.
Duel judged(Duel duel);

std::string to_console(const Duel& duel);

// Returns what a file holds.
nlohmann::ordered_json facts_of(const Duel& duel);

struct DuelOptions {
    std::string old_program, new_program;  // paths
    Options rows;                          // the configurations to compare
    double margin = 0.01;
    DuelClock clock = DuelClock::wall;
    int runs = 10;    // processes of each program
    int rounds = 20;  // pictures of each configuration by each program in a run
};

// Measures the configurations that the options select, without the baselines. Starts both programs again for each run.
// In each round, one program renders a configuration and the other renders it directly afterwards. The order of the
// configurations and of the two programs is random, so that a lasting disturbance slows both programs alike. The
// pictures are verified in the first run and must not change in later runs. If a program dies, its run is left out and
// a warning is added. `progress` receives the completed fraction, 0 to 1. Throws InputError if a program is not an
// executable file, and Error if no run was measured.
Duel run_duel(const DuelOptions& options, const std::function<void(double)>& progress);

}  // namespace mandelmarch::bench
