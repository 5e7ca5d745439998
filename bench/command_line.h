// SPDX-License-Identifier: Apache-2.0
// Command line of `bench`.
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
    std::vector<std::string> files;  // for compare, csv, json and portability
    DuelOptions duel;
    RaceOptions race;
    RandomOptions random;
    EquivalenceOptions equivalence;
    std::string folder;                  // equivalence: where to write scenes that differ; divergence: the sources
    std::vector<std::string> arguments;  // of a run, to pass on to further runs
    bool unproven = false;               // on_demand: skip verification, as in further runs of a duel
    bool quiet = false;                  // print no table and no progress, as in further runs
    bool list_names = false;             // --benchmark_list_tests
    int exit_code = 0;                   // for help
};

// Throws InputError for invalid arguments.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace mandelmarch::bench
