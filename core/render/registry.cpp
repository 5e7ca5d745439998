// SPDX-License-Identifier: Apache-2.0
#include "core/render/registry.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

class Absent : public Backend {
public:
    Absent(std::string_view name, std::string_view why) : name_(name), why_(why) {}

    std::string_view name() const override { return name_; }
    std::optional<std::string> unavailable() const override { return why_; }
    std::vector<Device> devices() const override { return {}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions&) const override
    {
        throw Unavailable(fmt::format("backend {}: {}", name_, why_));
    }

private:
    std::string name_;
    std::string why_;
};

}  // namespace

Listing listing_of(const Backend& backend)
{
    try {
        if (auto why = backend.unavailable()) return {{}, std::move(*why), {}};
        return {backend.devices(), {}, {}};
    } catch (const Error& error) {
        return {{}, {}, error.what()};
    }
}

Registry::Registry(std::vector<std::unique_ptr<Backend>> backends)
{
    for (auto& backend : backends) {
        (backend->info().argument.empty() ? backends_ : makers_).push_back(std::move(backend));
    }
}

const Backend* Registry::open(const std::string& name)
{
    if (const Backend* found = find(name)) return found;
    for (const auto& maker : makers_) {
        const std::string start = fmt::format("{}:", maker->name());
        if (!name.starts_with(start)) continue;
        backends_.push_back(maker->with_argument(name.substr(start.size())));
        return backends_.back().get();
    }
    return nullptr;
}

const Backend* Registry::find(std::string_view name) const
{
    const auto found = std::ranges::find(backends_, name, [](const auto& backend) { return backend->name(); });
    return found == backends_.end() ? nullptr : found->get();
}

std::vector<std::string> Registry::names() const
{
    std::vector<std::string> names;
    for (const auto& backend : backends_) names.emplace_back(backend->name());
    return names;
}

const Backend* Registry::find(Role role) const
{
    const auto found = std::ranges::find(backends_, role, [](const auto& backend) { return backend->info().role; });
    return found == backends_.end() ? nullptr : found->get();
}

const Backend& Registry::with(Role role) const
{
    const Backend* found = find(role);
    if (found == nullptr) {
        throw Unavailable(fmt::format("no backend of this build has the role '{}'", name_of(role)));
    }
    return *found;
}

AutomaticChoice Registry::automatic() const
{
    std::string reason;
    for (const auto& backend : backends_) {
        if (backend->info().role != Role::accelerator) continue;
        const Listing listing = listing_of(*backend);
        const auto gpu = std::ranges::find_if(listing.devices, &Device::is_gpu);
        if (gpu != listing.devices.end()) {
            return {backend.get(), fmt::format("GPU {}", gpu->name)};
        }
        if (!reason.empty()) reason += "; ";
        reason += !listing.failure.empty()       ? listing.failure
                  : !listing.unavailable.empty() ? fmt::format("{}: {}", backend->name(), listing.unavailable)
                                                 : fmt::format("no {} here", backend->info().gpus);
    }
    return {&with(Role::host), reason.empty() ? "this build has no accelerator" : reason};
}

std::unique_ptr<Backend> without_backend(std::string_view name, std::string_view why)
{
    return std::make_unique<Absent>(name, why);
}

}  // namespace mandelmarch
