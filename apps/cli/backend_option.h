// SPDX-License-Identifier: Apache-2.0
// The option --backend. Its value is `auto` or the name of a backend.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/render/registry.h"

namespace mandelmarch {

// Adds --backend and --no-isolation. `name` holds the default of --backend, and receives its value.
void add_backend_option(CLI::App& app, std::string& name, const Registry& registry);

// Adds --no-isolation, for programs without --backend. The option appears in the help and is accepted, but has no
// effect here, because program_backends() evaluates it before the program parses its arguments.
void add_isolation_option(CLI::App& app);

// Returns the backend called `name`. If `name` is "auto", this is the backend of Registry::automatic() or, if that
// backend does not support the options, the host's backend. For "auto" and if `tells` is true, also prints the choice
// with its reason.
const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells,
                              const RendererOptions& options = {});

// Throws InputError if the options set a number of threads or a SIMD width, and the backend does not support the option
// for it, --threads or --simd-width.
void refuse_unheeded(const Registry& registry, const Backend& backend, const RendererOptions& options);

}  // namespace mandelmarch
