// SPDX-License-Identifier: Apache-2.0
// Parses a program's arguments, and declares options whose value is one of several names.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mandelmarch {

// Parses the arguments. After --help or --version, returns the exit code with which the program should end; otherwise
// nullopt. Throws InputError if an argument is invalid or empty; the message begins with `program` and its command.
std::optional<int> parse_arguments(CLI::App& app, const std::string& program, int argc, char** argv);

// Throws InputError if an option was given that is not one of `taken`. `mode`: the option that selects what the program
// does.
void refuse_others(const CLI::App& app, const std::string& mode, const std::vector<std::string>& taken);

// Adds an option that sets `value` to one of the named values. Its default is the current value.
template <class Value>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Value& value,
                        std::vector<std::pair<std::string, Value>> choices, const std::string& about)
{
    std::vector<std::string> names;
    std::string chosen;
    for (const auto& [name, choice] : choices) {
        names.push_back(name);
        if (choice == value) chosen = name;
    }
    const auto set = [&value, choices = std::move(choices)](const std::string& text) {
        value = std::ranges::find(choices, text, &std::pair<std::string, Value>::first)->second;
    };
    return app.add_option_function<std::string>(option, set, about)->check(CLI::IsMember(names))->default_str(chosen);
}

}  // namespace mandelmarch
