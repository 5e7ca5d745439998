// SPDX-License-Identifier: Apache-2.0
#include "cli/arguments.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace mandelmarch {
namespace {

struct OldName {
    std::string_view old_name, new_name;
};

// Names of version 1, which stay valid for one release.
constexpr OldName options[] = {{"--launch", "--run"}, {"--launches", "--runs"}, {"--pack", "--simd-width"}};
constexpr OldName values[] = {{"--estimate=counted", "--estimate=original"},
                              {"--study=blocks", "--study=block-sizes"},
                              {"--study=packs", "--study=simd-widths"}};

std::string with_new_option(const std::string& word)
{
    const auto equals = std::min(word.find('='), word.size());
    const auto* const found = std::ranges::find(options, std::string_view(word).substr(0, equals), &OldName::old_name);
    return found == std::end(options) ? word : std::string(found->new_name) + word.substr(equals);
}

// Returns the arguments with today's names.
std::vector<std::string> with_new_names(int argc, char** argv)
{
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        std::string word = with_new_option(argv[i]);
        for (const OldName& value : values) {
            const auto equals = value.old_name.find('=');
            const bool after_option = !words.empty() && words.back() == value.old_name.substr(0, equals) &&
                                      word == value.old_name.substr(equals + 1);
            if (after_option) word = value.new_name.substr(equals + 1);
            if (word == value.old_name) word = value.new_name;
        }
        words.push_back(std::move(word));
    }
    return words;
}

}  // namespace

std::optional<int> parse_arguments(CLI::App& app, const std::string& program, int argc, char** argv)
{
    std::vector<std::string> words = with_new_names(argc, argv);
    std::ranges::reverse(words);  // as CLI11 takes them
    try {
        app.parse(std::move(words));
    } catch (const CLI::Success& answer) {  // --help, --version
        return app.exit(answer);
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("{}: {} (--help lists the options)", program, error.what()));
    }
    return std::nullopt;
}

}  // namespace mandelmarch
