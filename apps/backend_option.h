// SPDX-License-Identifier: Apache-2.0
// The option --backend: `auto`, or a backend by its name.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "core/render/registry.h"

namespace mandelmarch {

void add_backend_option(CLI::App& app, std::string& name, const Registry& registry);

// --no-isolation, which program_backends() reads before a program parses its arguments; add_backend_option() adds it,
// too.
void add_isolation_option(CLI::App& app);

// The backend of that name. What `auto` chose, and why, is said where `tells`.
const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells,
                              const RendererOptions& options = {});

// Throws InputError if the options give a number of threads or a pack width and the backend does not support it.
void refuse_unheeded(const Registry& registry, const Backend& backend, const RendererOptions& options);

}  // namespace mandelmarch
