// SPDX-License-Identifier: Apache-2.0
// The option --estimate: the original program's distance estimate, or the fractal's conservative one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace mandelmarch {

inline constexpr const char* counted_estimate = "counted";
inline constexpr const char* conservative_estimate = "conservative";

// `name` is the default, too.
inline void add_estimate_option(CLI::App& app, std::string& name)
{
    app.add_option(
           "--estimate", name,
           "counted: the original's distance estimate; conservative: one that is seldom larger than the distance")
        ->check(CLI::IsMember({counted_estimate, conservative_estimate}))
        ->capture_default_str();
}

}  // namespace mandelmarch
