// SPDX-License-Identifier: Apache-2.0
// The commands of bench. Each function declares a command's options and returns what the command does; the returned
// function is called after parsing, and returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "core/render/registry.h"

namespace mandelmarch::bench {

using Run = std::function<int()>;

// `arguments`: bench's command line. The command lines of further runs are made from it.
Run measure_command(CLI::App& app, Registry& registry, const std::vector<std::string>& arguments);

// Declares a command that prints a text about one stored file.
Run with_file(CLI::App& app, std::string (*text)(const std::string& path));

Run compare_command(CLI::App& app, Registry& registry);
Run csv_command(CLI::App& app, Registry& registry);
Run json_command(CLI::App& app, Registry& registry);
Run schema_command(CLI::App& app, Registry& registry);
Run portability_command(CLI::App& app, Registry& registry);
Run peak_command(CLI::App& app, Registry& registry);

Run random_command(CLI::App& app, Registry& registry);
Run equivalence_command(CLI::App& app, Registry& registry);

}  // namespace mandelmarch::bench
