// SPDX-License-Identifier: Apache-2.0
#include "apps/backend_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/console.h"

namespace mandelmarch {

void add_backend_option(CLI::App& app, std::string& name, const Registry& registry)
{
    std::vector<std::string> names = registry.names();
    names.insert(names.begin(), "auto");
    app.add_option("--backend", name, fmt::format("{}", fmt::join(names, ", ")))
        ->check(CLI::IsMember(names))
        ->capture_default_str();
    add_isolation_option(app);
}

void add_isolation_option(CLI::App& app)
{
    app.add_flag("--no-isolation")->description("run device drivers in this process, for profilers and debuggers");
}

const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells)
{
    if (name != "auto") return *registry.find(name);
    const AutomaticChoice choice = registry.automatic();
    if (tells) say("backend {}: {}\n", choice.backend->name(), choice.reason);
    return *choice.backend;
}

}  // namespace mandelmarch
