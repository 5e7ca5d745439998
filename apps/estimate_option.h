// SPDX-License-Identifier: Apache-2.0
// The option --estimate: the original program's distance estimate, or the fractal's conservative one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/scene/scene.h"

namespace mandelmarch {

// `name` is the default, too.
inline void add_estimate_option(CLI::App& app, std::string& name)
{
    app.add_option(
           "--estimate", name,
           "counted: the original's distance estimate; conservative: one that is seldom larger than the distance")
        ->check(CLI::IsMember({std::string(counted_estimate), std::string(conservative_estimate)}))
        ->capture_default_str();
}

}  // namespace mandelmarch
