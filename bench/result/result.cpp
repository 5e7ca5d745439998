// SPDX-License-Identifier: Apache-2.0
#include "bench/result/result.h"

#include <fmt/format.h>

#include <algorithm>

namespace mandelmarch::bench {
namespace {

// Returns the name of the backend with this role; empty if none has it.
std::string backend_with(const nlohmann::ordered_json& environment, Role role)
{
    const auto backends = environment.find("backends");
    if (backends != environment.end() && backends->is_array()) {
        for (const auto& backend : *backends) {
            const auto text = [&](const char* key) {
                const auto found = backend.is_object() ? backend.find(key) : backend.end();
                return found != backend.end() && found->is_string() ? found->get<std::string>() : std::string();
            };
            if (text("role") == name_of(role)) return text("name");
        }
    }
    return {};
}

}  // namespace

std::string Row::name() const
{
    if (fractal == "all") return backend;
    return fmt::format("{}/{}/{}/{}/{}{}{}", fractal, name_of(precision), name_of(mode), backend, device,
                       sweep_value.empty() ? "" : "/", sweep_value);
}

bool Result::failed() const { return std::ranges::any_of(rows, &Row::failed); }

std::string Result::reference() const { return backend_with(environment, Role::reference); }

std::string Result::host() const { return backend_with(environment, Role::host); }

const Row& Result::row(std::string_view name) const
{
    return *std::ranges::find_if(rows, [&](const Row& row) { return row.name() == name; });
}

void raise_peaks(std::vector<Peak>& to, const std::vector<Peak>& from)
{
    for (const Peak& peak : from) {
        const auto same = std::ranges::find_if(to, [&](const Peak& known) { return known.same_device(peak); });
        if (same == to.end()) {
            to.push_back(peak);
        } else {
            same->rate = std::max(same->rate, peak.rate);
        }
    }
}

}  // namespace mandelmarch::bench
