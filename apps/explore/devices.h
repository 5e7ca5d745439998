// SPDX-License-Identifier: Apache-2.0
// The list of all backends' devices. It is made in the background, because drivers can be slow.
#pragma once

#include <string>
#include <vector>

#include "apps/explore/task.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

class Devices {
public:
    explicit Devices(const Registry& registry) : registry_(registry)
    {
        task_.start([&registry] {
            std::vector<Listing> found;
            for (const auto& backend : registry.backends()) found.push_back(listing_of(*backend));
            return found;
        });
    }

    const Registry& registry() const { return registry_; }

    // Returns one listing per backend, in the registry's order. Empty until the devices of all backends are listed.
    const std::vector<Listing>& listings()
    {
        std::string failure;
        if (auto found = task_.take(failure)) listings_ = std::move(*found);
        return listings_;
    }

private:
    const Registry& registry_;
    Task<std::vector<Listing>> task_;
    std::vector<Listing> listings_;
};

}  // namespace mandelmarch::explore
