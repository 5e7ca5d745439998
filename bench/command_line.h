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

enum class Command { run, compare, csv, duel, json, on_demand, peak, portability, race, random, equivalence, help };

struct CommandLine {
    Command command = Command::run;
    Options options;
    std::vector<std::string> files;  // for compare, csv, json and portability
    DuelOptions duel;
    RaceOptions race;
    RandomOptions random;
    EquivalenceOptions equivalence;
    std::string folder;                  // equivalence: for parameter files of scenes that differ
    std::vector<std::string> arguments;  // to pass on to the further runs that --runs starts
    bool unproven = false;               // on_demand: skip verification; set in all runs of a duel but the first
    bool quiet = false;                  // print no table and no progress; set in further runs
    bool list_names = false;             // --benchmark_list_tests
    int exit_code = 0;                   // if the command is help
};

// Throws InputError for invalid arguments.
CommandLine parse_command_line(int argc, char** argv);

}  // namespace mandelmarch::bench
