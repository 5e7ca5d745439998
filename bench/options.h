// SPDX-License-Identifier: Apache-2.0
// What the user asked of `bench`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace mandelmarch::bench {

struct Options {
    std::string backend = "all";
    std::string fractal = "all";  // all: those that are studied; or a fractal's name or nickname
    std::string precision = "all";
    std::string mode;  // empty: all in the standard study, exact in sweeps
    std::string size;  // WxH; empty: the study's own
    std::string study = "standard";
    std::string
        filter;  // as Google Benchmark's: a regular expression that is looked for in a row's name; -: all others
    std::optional<int> repetitions;  // exactly so many rounds; without it the stop rule decides
    int launches = 1;
    int launch = 0;                // of this process, from 0
    std::uint64_t seed = 1;        // of the order of rows in each round
    std::optional<double> budget;  // seconds that the timed rounds may take
    std::string json, csv;         // files; - is standard output
    bool list = false, wide = false;
    bool peaks = true;      // measured before and after the rounds; without them there are no shares of peak
    bool baselines = true;  // with the rows that others are compared with, in the standard study
    // Google Benchmark's own.
    std::string format, out, out_format = "json";
};

}  // namespace mandelmarch::bench
