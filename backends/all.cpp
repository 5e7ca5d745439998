// SPDX-License-Identifier: Apache-2.0
#include "backends/all.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <span>
#include <string_view>

#include "core/base/error.h"
#include "core/isolation/isolated.h"
#include "core/render/trial.h"
#include "registrations.h"

namespace mandelmarch {

// The factories of the backends, each defined in the backend's folder. registrations.h, which mandelmarch_registry()
// generates (cmake/Backend.cmake), defines MM_BACKENDS as the list of backends, built or not.
#define MM_BUILT(name) std::unique_ptr<Backend> make_##name##_backend();
#define MM_NOT_BUILT(name)
MM_BACKENDS
#undef MM_BUILT
#undef MM_NOT_BUILT

namespace {

std::string_view variable(const char* name)
{
    const char* text = std::getenv(name);
    return text != nullptr ? text : "";
}

bool isolates(std::span<char*> arguments)
{
    const std::string_view isolation = variable("MANDELMARCH_ISOLATION");
    if (!isolation.empty() && isolation != "off" && isolation != "on") {
        throw InputError(fmt::format("MANDELMARCH_ISOLATION: '{}' given, expected on or off", isolation));
    }
    const bool refused = std::ranges::any_of(arguments, [](std::string_view one) { return one == "--no-isolation"; });
    return !refused && isolation != "off";
}

// Returns the names in MANDELMARCH_BACKENDS. If it is not set, the list is empty and all backends are allowed.
std::vector<std::string_view> opened_backends()
{
    std::vector<std::string_view> known;
#define MM_BUILT(name) known.push_back(#name);
#define MM_NOT_BUILT(name) known.push_back(#name);
    MM_BACKENDS
#undef MM_BUILT
#undef MM_NOT_BUILT
    std::vector<std::string_view> names;
    for (std::string_view rest = variable("MANDELMARCH_BACKENDS"); !rest.empty();) {
        const std::size_t comma = std::min(rest.find(','), rest.size());
        names.push_back(rest.substr(0, comma));
        rest.remove_prefix(std::min(comma + 1, rest.size()));
        if (std::ranges::find(known, names.back()) != known.end()) continue;
        throw InputError(fmt::format("MANDELMARCH_BACKENDS: '{}' given, expected some of {} with commas between them",
                                     names.back(), fmt::join(known, ", ")));
    }
    return names;
}

Registry backends_of(bool isolates_drivers, const std::vector<std::string_view>& opened)
{
    std::vector<std::unique_ptr<Backend>> backends;
    const auto add = [&](std::unique_ptr<Backend> backend) {
        const BackendInfo info = backend->info();
        if (info.has_driver && !opened.empty() && std::ranges::find(opened, backend->name()) == opened.end()) {
            backends.push_back(without_backend(backend->name(), "left out by MANDELMARCH_BACKENDS"));
            return;
        }
        // The reference backend needs no trial renders (core/render/trial.h), because its steps are short enough.
        if (info.role != Role::reference) backend = with_trials(std::move(backend));
        if (info.has_driver && isolates_drivers) backend = isolated(std::move(backend));
        backends.push_back(std::move(backend));
    };
#define MM_BUILT(name) add(make_##name##_backend());
#define MM_NOT_BUILT(name) backends.push_back(without_backend(#name, "not built"));
    MM_BACKENDS
#undef MM_BUILT
#undef MM_NOT_BUILT
    return Registry(std::move(backends));
}

}  // namespace

Registry all_backends() { return backends_of(false, {}); }

Registry program_backends(int argc, char** argv)
{
    return backends_of(isolates({argv, static_cast<std::size_t>(argc)}), opened_backends());
}

}  // namespace mandelmarch
