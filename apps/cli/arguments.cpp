// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/arguments.h"

#include <fmt/format.h>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

// Throws InputError if a word is empty, as that of a shell variable without a value is.
void refuse_empty_words(const std::string& program, int argc, char** argv)
{
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const std::string before = argv[i - 1];
        if (word.starts_with("--") && word.ends_with('=')) {
            throw InputError(fmt::format("{}: '{}' given, expected a value behind =", program, word));
        }
        if (!word.empty()) continue;
        throw InputError(fmt::format("{}: {}: '' given, expected a value", program,
                                     before.starts_with('-') ? before : fmt::format("argument {}", i)));
    }
}

}  // namespace

std::optional<int> parse_arguments(CLI::App& app, const std::string& program, int argc, char** argv)
{
    app.name(program);  // for the line "Usage" of the help text
    refuse_empty_words(program, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& answer) {  // --help, --version
        return app.exit(answer);
    } catch (const CLI::ParseError& error) {
        const auto commands = app.get_subcommands();
        const std::string command = commands.empty() ? program : program + " " + commands.front()->get_name();
        std::string what = error.what();
        // An unknown option is named rather than the words behind it, which CLI11 does not take for its value.
        if (const std::vector<std::string> unknown = app.remaining(true); !unknown.empty()) {
            const auto option = std::ranges::find_if(unknown, [](auto& word) { return word.starts_with('-'); });
            what = "not expected: " + (option != unknown.end() ? *option : unknown.front());
        }
        throw InputError(fmt::format("{}: {} ({} --help lists the options)", command, what, command));
    }
    return std::nullopt;
}

void refuse_others(const CLI::App& app, const std::string& mode, const std::vector<std::string>& taken)
{
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || name == "--no-isolation" || std::ranges::find(taken, name) != taken.end()) continue;
        throw InputError(fmt::format("{}: not expected with {}", name, mode));
    }
}

}  // namespace mandelmarch
