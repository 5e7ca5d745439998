// SPDX-License-Identifier: Apache-2.0
#include "cli/arguments.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace mandelmarch {
namespace {

// Old names of options, which stay valid for one release.
struct OldOption {
    std::string_view old_name, new_name;
};
constexpr OldOption old_options[] = {{"--launch", "--run"}, {"--launches", "--runs"}, {"--pack", "--simd-width"}};

struct OldValue {
    std::string_view option, old_name, new_name;
};
constexpr OldValue old_values[] = {
    {"--estimate", "counted", "original"}, {"--study", "blocks", "block-sizes"},
    {"--study", "packs", "simd-widths"},   {"--without", "normal", "gradient"},
    {"--without", "root", "refinement"},   {"--without", "surroundings", "shared-occlusion"}};

std::string with_new_option(const std::string& name)
{
    const auto* const found = std::ranges::find(old_options, name, &OldOption::old_name);
    return found == std::end(old_options) ? name : std::string(found->new_name);
}

// `value`: one name, or several with commas between them.
std::string with_new_values(const std::string& option, const std::string& value)
{
    std::string made;
    for (std::size_t at = 0; at <= value.size();) {
        const auto comma = std::min(value.find(',', at), value.size());
        std::string name = value.substr(at, comma - at);
        for (const OldValue& old : old_values) {
            if (option == old.option && name == old.old_name) name = old.new_name;
        }
        made += (at == 0 ? "" : ",") + name;
        at = comma + 1;
    }
    return made;
}

// Returns the arguments with old names replaced by new ones.
std::vector<std::string> with_new_names(int argc, char** argv)
{
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto equals = word.starts_with("--") ? word.find('=') : std::string::npos;
        if (equals != std::string::npos) {
            const std::string option = with_new_option(word.substr(0, equals));
            words.push_back(option + "=" + with_new_values(option, word.substr(equals + 1)));
        } else {
            words.push_back(words.empty() ? with_new_option(word)
                                          : with_new_values(words.back(), with_new_option(word)));
        }
    }
    return words;
}

}  // namespace

std::optional<int> parse_arguments(CLI::App& app, const std::string& program, int argc, char** argv)
{
    app.name(program);  // for the line "Usage" of the help text
    std::vector<std::string> words = with_new_names(argc, argv);
    std::ranges::reverse(words);  // CLI11 parses a vector from its end
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
