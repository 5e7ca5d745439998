#include "backends/all.h"

#include "backends/openmp/openmp.h"
#include "backends/reference/reference.h"
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

Registry all_backends()
{
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(with_trials(make_openmp_backend()));
#ifdef MANDELMARCH_HAS_OPENACC
    backends.push_back(with_trials(make_openacc_backend()));
#else
    backends.push_back(not_built("openacc"));
#endif
#ifdef MANDELMARCH_HAS_OPENCL
    backends.push_back(with_trials(make_opencl_backend()));
#else
    backends.push_back(not_built("opencl"));
#endif
#ifdef MANDELMARCH_HAS_VULKAN
    backends.push_back(with_trials(make_vulkan_backend()));
#else
    backends.push_back(not_built("vulkan"));
#endif
    return Registry(std::move(backends));
}

}  // namespace mandelmarch
