// SPDX-License-Identifier: Apache-2.0
// Options of `bench`, as given by the user.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace mandelmarch::bench {

struct Options {
    std::string backend = "all";
    std::string fractal = "all";  // all: those studied by default; or a fractal's name or short_name
    std::string precision = "all";
    std::string mode;  // empty: exact in sweeps, fast in the study ablation, else both
    std::string size;  // WxH; empty: default of the study
    std::string study = "standard";
    std::string filter;  // regular expression searched in names; a leading - inverts it (as in Google Benchmark)
    std::optional<int> repetitions;  // exact number of rounds; empty: the stop rule decides
    int runs = 1;                // number of runs
    int run = 0;                  // index of this run, from 0
    std::uint64_t seed = 1;          // for the order of configurations in each round
    std::optional<double> budget;    // seconds for the timed rounds
    std::string json, csv;           // files; -: standard output
    bool list = false, wide = false;
    bool peaks = true;      // measure peaks before and after the rounds; needed for the share of peak
    bool baselines = true;  // include the baselines of the standard study
    // Values of Google Benchmark's options --benchmark_format, _out and _out_format.
    std::string format, out, out_format = "json";
};

}  // namespace mandelmarch::bench
