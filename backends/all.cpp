// SPDX-License-Identifier: Apache-2.0
#include "backends/all.h"

#include "core/isolation/isolated.h"
#include "core/render/trial.h"
#include "registrations.h"

namespace mandelmarch {

Registry all_backends(Drivers drivers)
{
    std::vector<std::unique_ptr<Backend>> backends;
    const auto add = [&](std::unique_ptr<Backend> backend) {
        const Facts facts = backend->facts();
        // The reference's short steps pass through nothing.
        if (facts.role != Role::reference) backend = with_trials(std::move(backend));
        if (facts.has_driver && drivers == Drivers::isolated) backend = isolated(std::move(backend));
        backends.push_back(std::move(backend));
    };
#define MM_BUILT(name) add(make_##name##_backend());
#define MM_NOT_BUILT(name) backends.push_back(not_built(#name));
    MM_BACKENDS
#undef MM_BUILT
#undef MM_NOT_BUILT
    return Registry(std::move(backends));
}

}  // namespace mandelmarch
