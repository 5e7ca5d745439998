// SPDX-License-Identifier: Apache-2.0
// The commands of bench. The members of a command are the values of its options. declare() declares the options, and
// run(), called after parsing, returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "bench/command/outputs.h"
#include "bench/fidelity/equivalence.h"
#include "bench/fidelity/random_scenes.h"
#include "bench/measure/options.h"
#include "core/render/registry.h"

namespace mandelmarch::bench {

// Measures a study.
struct MeasureCommand {
    std::vector<std::string> arguments;  // the program's arguments, which it passes to further runs
    Options options{};
    Outputs outputs{};
    std::string earlier{};  // stored result to continue; empty: none
    bool list = false, wide = false;

    void declare(CLI::App& app, Registry& registry);
    int run(Registry& registry) const;
};

struct PeakCommand {
    Options options;

    void declare(CLI::App& app, Registry& registry);
    int run(Registry& registry) const;
};

struct RandomCommand {
    RandomOptions options{.fractals = default_fractals()};
    Outputs outputs;

    void declare(CLI::App& app, Registry& registry);
    int run(Registry& registry) const;
};

struct EquivalenceCommand {
    EquivalenceOptions options;
    std::string folder;  // for parameter files of scenes whose pictures differ; empty: none
    Outputs outputs;

    void declare(CLI::App& app, Registry& registry);
    int run(Registry& registry) const;
};

struct CompareCommand {
    std::vector<std::string> files;

    void declare(CLI::App& app, Registry& registry);
    int run(Registry& registry) const;
};

struct PortabilityCommand {
    std::vector<std::string> paths;
    Outputs outputs;

    void declare(CLI::App& app, Registry& registry);
    int run(Registry& registry) const;
};

// Prints the text that its only argument selects.
struct PrintCommand {
    std::string name, about;  // the argument's name and description, for the help text
    std::string (*text)(const std::string& argument);
    std::string argument{};

    void declare(CLI::App& app, Registry& registry);
    int run(Registry& registry) const;
};

// Texts of such commands: a stored result as CSV, a stored file with all figures that follow from its facts, and the
// JSON Schema of a kind of file.
std::string stored_csv(const std::string& path);
std::string derived_json(const std::string& path);
std::string schema_text(const std::string& kind);

}  // namespace mandelmarch::bench
