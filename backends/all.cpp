// SPDX-License-Identifier: Apache-2.0
#include "backends/all.h"

#include "backends/openmp/openmp.h"
#include "backends/reference/reference.h"
#include "core/isolation/isolated.h"
#include "core/render/trial.h"
#ifdef MANDELMARCH_HAS_OPENACC
#include "backends/openacc/openacc.h"
#endif
#ifdef MANDELMARCH_HAS_OPENCL
#include "backends/opencl/opencl.h"
#endif
#ifdef MANDELMARCH_HAS_VULKAN
#include "backends/vulkan/vulkan.h"
#endif

namespace mandelmarch {

Registry all_backends(Drivers drivers)
{
    [[maybe_unused]] const auto with_driver = [&](std::unique_ptr<Backend> backend) {
        backend = with_trials(std::move(backend));
        return drivers == Drivers::isolated ? isolated(std::move(backend)) : std::move(backend);
    };
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(with_trials(make_openmp_backend()));
#ifdef MANDELMARCH_HAS_OPENACC
    backends.push_back(with_driver(make_openacc_backend()));
#else
    backends.push_back(not_built("openacc"));
#endif
#ifdef MANDELMARCH_HAS_OPENCL
    backends.push_back(with_driver(make_opencl_backend()));
#else
    backends.push_back(not_built("opencl"));
#endif
#ifdef MANDELMARCH_HAS_VULKAN
    backends.push_back(with_driver(make_vulkan_backend()));
#else
    backends.push_back(not_built("vulkan"));
#endif
    return Registry(std::move(backends));
}

}  // namespace mandelmarch
