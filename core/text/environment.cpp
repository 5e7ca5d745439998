// SPDX-License-Identifier: Apache-2.0
#include "core/text/environment.h"

#include <fmt/format.h>

#include <cstdlib>

#include "core/text/error.h"
#include "core/text/number.h"

namespace mandelmarch {

std::string environment_variable(VariableName name)
{
    const char* value = std::getenv(name.text);
    return value != nullptr ? value : "";
}

double environment_seconds(VariableName name, double usual)
{
    constexpr double least = 1e-3;
    constexpr double most = 1e6;  // its milliseconds fit into the int that poll() takes
    const std::string text = environment_variable(name);
    if (text.empty()) return usual;
    const auto seconds = parse_real(text);
    if (seconds && *seconds >= least && *seconds <= most) return *seconds;
    throw InputError(fmt::format("{}: '{}' given, expected seconds from {} to {:.0f}", name.text, text, least, most));
}

std::map<std::string, std::string> recorded_variables()
{
    std::map<std::string, std::string> set;
    for (const Variables& row : variables) {
        for (const char* name : row.names) {
            if (!row.recorded || name == nullptr) continue;
            if (const char* value = std::getenv(name)) set.emplace(name, value);
        }
    }
    return set;
}

std::string environment_help(std::string_view program)
{
    std::string text = "\nEnvironment variables (all: core/text/environment.h):";
    for (const Variables& row : variables) {
        const bool reads = row.readers == "all programs" || row.readers.find(program) != std::string_view::npos;
        if (!reads || !std::string_view(row.names[0]).starts_with("MANDELMARCH_")) continue;
        text.append("\n  ").append(row.names[0]).append(": ").append(row.meaning);
    }
    return text;
}

double device_timeout()
{
    constexpr double usual = 300;
    return environment_seconds("MANDELMARCH_DEVICE_TIMEOUT", usual);
}

}  // namespace mandelmarch
