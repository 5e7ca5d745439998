// SPDX-License-Identifier: Apache-2.0
// The option --backend: `auto`, or a backend by its name.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/render/registry.h"

namespace mandelmarch {

void add_backend_option(CLI::App& app, std::string& name, const Registry& registry);

// Adds --no-isolation, as add_backend_option() does. Its value comes from program_backends(), which reads it before a
// program parses its arguments.
void add_isolation_option(CLI::App& app);

// Returns the backend called `name`, or chooses one if `name` is "auto"; then, if `tells`, prints the choice and its
// reason.
const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells,
                              const RendererOptions& options = {});

// Throws InputError if the options set a number of threads or a SIMD width and the backend does not support that.
void refuse_unheeded(const Registry& registry, const Backend& backend, const RendererOptions& options);

}  // namespace mandelmarch
