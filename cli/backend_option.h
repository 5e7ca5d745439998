// SPDX-License-Identifier: Apache-2.0
// The option --backend. Its value is `auto` or the name of a backend.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/render/registry.h"

namespace mandelmarch {

// Adds --backend and --no-isolation. `name` contains the default, and receives the value.
void add_backend_option(CLI::App& app, std::string& name, const Registry& registry);

// Adds --no-isolation, for programs without --backend. The option is only shown and accepted here:
// program_backends() evaluates it before a program parses its arguments.
void add_isolation_option(CLI::App& app);

// Returns the backend called `name`. If `name` is "auto", chooses a backend and, if `tells` is true, prints the choice
// with its reason. Chooses the host's backend if the GPU's backend does not support the options.
const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells,
                              const RendererOptions& options = {});

// Throws InputError if the options set a number of threads or a SIMD width and the backend does not support that
// option.
void refuse_unheeded(const Registry& registry, const Backend& backend, const RendererOptions& options);

}  // namespace mandelmarch
