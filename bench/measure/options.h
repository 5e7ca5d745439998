// SPDX-License-Identifier: Apache-2.0
// Options that choose what bench measures.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure/studies.h"
#include "bench/measure/views.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

struct Options {
    const Study* study = &studies().front();
    std::vector<std::string> backends;  // names; empty: all
    std::vector<const Fractal*> fractals = default_fractals();
    std::vector<Precision> precisions{Precision::f64, Precision::f32};
    std::vector<Mode> modes;                  // empty: the modes of the study
    std::string scene;                        // parameter file of the only fractal; empty: the views of the study
    std::optional<std::pair<int, int>> size;  // pixels; nullopt: the size of `scene` or of the study
    std::string filter;  // patterns with commas between them (docs/bench.md); a leading - selects the other names

    std::optional<int> repetitions;  // exact number of rounds; nullopt: as many as needed (bench/measure/runner.h)
    int runs = 1;                    // number of runs
    int run = 0;                     // index of this run, from 0
    std::uint64_t seed = 1;          // for the order of configurations in each round
    std::optional<double> budget;    // seconds for the timed rounds; nullopt: automatic (bench/measure/session.cpp)
    bool peaks = true;               // measure peak rates; results give the share of the peak that is achieved
    bool move_eye = false;           // each round has other views (bench/measure/moving_eye.h)

    bool selects(std::string_view backend) const;
    const std::vector<Mode>& selected_modes() const { return modes.empty() ? study->modes : modes; }
    std::pair<int, int> picture_size() const { return size.value_or(std::pair(study->width, study->height)); }
};

// Parses a list of backends, separated by commas, and opens them; `all`: an empty list. Throws InputError for an
// unknown name.
std::vector<std::string> parse_backends(Registry& registry, std::string_view text);

// Declares --fractal, which replaces `fractals` by one of a given name, unless that is "all".
void add_fractal(CLI::App& app, std::vector<const Fractal*>& fractals, const std::string& about);

// Declares --backend and --precision, which set members of `options`.
void add_devices(CLI::App& app, Registry& registry, Options& options);

// Declares these options, and --fractal, --mode, --scene, --size, --study and --filter.
void add_selection(CLI::App& app, Registry& registry, Options& options);

}  // namespace mandelmarch::bench
