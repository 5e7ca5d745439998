// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/backend_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text/console.h"
#include "core/text/error.h"

namespace mandelmarch {

void add_backend_option(CLI::App& app, std::string& name, const Registry& registry)
{
    std::vector<std::string> names = registry.names();
    names.insert(names.begin(), "auto");
    app.add_option("--backend", name, "rendering backend; auto: one for GPUs if a GPU is present, else openmp")
        ->check(CLI::IsMember(names))
        ->capture_default_str();
    add_isolation_option(app);
}

void add_isolation_option(CLI::App& app)
{
    app.add_flag("--no-isolation")
        ->description("run device drivers in this process instead of their own, for profilers and debuggers");
}

std::string unheeded(const Backend& backend, const RendererOptions& options)
{
    const BackendInfo info = backend.info();
    if (options.threads > 0 && !info.threads) return "--threads";
    if (options.simd_width > 0 && !info.simd_width) return "--simd-width";
    return {};
}

void refuse_unheeded(const Registry& registry, const Backend& backend, const RendererOptions& options)
{
    const std::string option = unheeded(backend, options);
    if (option.empty()) return;
    std::vector<std::string_view> heeding;
    for (const auto& other : registry.backends()) {
        if (unheeded(*other, option == "--threads" ? RendererOptions{.threads = 1} : RendererOptions{.simd_width = 1})
                .empty())
            heeding.push_back(other->name());
    }
    throw InputError(fmt::format("{}: not supported by backend {}, expected one of {}", option, backend.name(),
                                 fmt::join(heeding, ", ")));
}

const Backend& chosen_backend(const Registry& registry, const std::string& name, bool tells,
                              const RendererOptions& options)
{
    if (name != "auto") return *registry.find(name);
    AutomaticChoice choice = registry.automatic();
    if (const std::string option = unheeded(*choice.backend, options); !option.empty()) {
        choice = {&registry.with(Role::host), fmt::format("{} is given", option)};
    }
    if (tells) say("drawing with {} ({})\n", choice.backend->name(), choice.reason);
    return *choice.backend;
}

}  // namespace mandelmarch
