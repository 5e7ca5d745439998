#include "backends/all.h"

#include "backends/openmp/openmp.h"
#include "backends/reference/reference.h"

namespace mandelmarch {

Registry all_backends()
{
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(make_openmp_backend());
    for (const char* name : {"openacc", "opencl", "vulkan"}) backends.push_back(not_built(name));
    return Registry(std::move(backends));
}

}  // namespace mandelmarch
