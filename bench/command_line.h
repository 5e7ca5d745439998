// SPDX-License-Identifier: Apache-2.0
// The command line of `bench`. Internal to the program.
#pragma once

#include <string>
#include <vector>

#include "bench/duel_run.h"
#include "bench/equivalence.h"
#include "bench/options.h"
#include "bench/race_run.h"
#include "bench/random_scenes.h"

namespace mandelmarch::bench {

enum class Command {
    run,
    compare,
    csv,
    divergence,
    duel,
    json,
    on_demand,
    peak,
    portability,
    race,
    random,
    equivalence,
    help
};

struct CommandLine {
    Command command = Command::run;
    Options options;
    std::vector<std::string> files;  // of compare, csv, json and portability
    DuelPlan duel;
    RacePlan race;
    RandomOptions random;
    EquivalenceOptions equivalence;
    std::string folder;                  // of equivalence: for scenes that differ; of divergence: the sources
    std::vector<std::string> arguments;  // of a run, without those that only the first launch obeys
    bool unproven = false;               // of on_demand: a launch of a duel that proves no pictures
    bool quiet = false;                  // no table and no progress: a further launch
    bool list_names = false;             // --benchmark_list_tests
    int exit_code = 0;                   // of help
};

// Throws InputError for what is not understood.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace mandelmarch::bench
