// SPDX-License-Identifier: Apache-2.0
// The stdpar backend: the kernel in std::for_each of C++ standard parallelism, on all cores.
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/version.h>

#include <algorithm>

#include "core/os/cores.h"
#include "core/os/cpu.h"
#include "core/models/model.h"

namespace mandelmarch {
namespace stdpar {
job::DrawKernel* drawing(std::string_view variant);
job::Chains* chains(std::string_view precision);
}  // namespace stdpar

namespace {

class Stdpar : public job::Model {
public:
    std::string_view name() const override { return "stdpar"; }
    BackendInfo info() const override
    {
        return {.title = "C++ standard parallelism",
                .distribution = "the model's own loop over the pixels of a band, one after the other in each thread",
                .threads = true,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    job::Kernels kernels() const override { return {stdpar::drawing, stdpar::chains}; }

    job::OpenedDevice open(int) const override
    {
        const Device device{.name = cpu_name(),
                            .vendor = cpu_vendor(),
                            .driver = fmt::format("TBB {}.{}", TBB_VERSION_MAJOR, TBB_VERSION_MINOR),
                            .is_gpu = false};
        // By default TBB starts at most one thread for each core that it detects.
        const int threads = std::min(usable_threads(), tbb::info::default_concurrency());
        return {.device = device, .threads = threads, .in_cells = true};
    }

    // Sets the number of threads with TBB, because the C++ standard has no function for it.
    job::Selection select(const RendererOptions& options) const override
    {
        const int most = options.threads == 0 ? usable_threads() : options.threads;
        return std::make_shared<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                     static_cast<std::size_t>(most));
    }
    int threads(const RendererOptions& options, const job::OpenedDevice& opened) const override
    {
        return options.threads == 0 ? opened.threads : options.threads;
    }
};

}  // namespace

std::unique_ptr<Backend> make_stdpar_backend() { return job::backend_of(std::make_unique<Stdpar>()); }

}  // namespace mandelmarch
