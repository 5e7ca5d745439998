// SPDX-License-Identifier: Apache-2.0
// The kokkos backend: the kernel in a Kokkos::parallel_for, in the default host space of Kokkos.
#include <fmt/format.h>

#include <Kokkos_Core.hpp>

#include "backends/kokkos/loop.h"
#include "core/os/cores.h"
#include "core/os/cpu.h"
#include "core/models/model.h"

namespace mandelmarch {
namespace kokkos {
job::DrawKernel* drawing(std::string_view variant);
job::Chains* chains(std::string_view precision);
}  // namespace kokkos

namespace {

// Returns settings with as many threads as the process may use. Kokkos prefers KOKKOS_NUM_THREADS, if it is set.
auto settings()
{
#if KOKKOS_VERSION >= 30700
    return Kokkos::InitializationSettings().set_num_threads(usable_threads());
#else
    Kokkos::InitArguments arguments;
    arguments.num_threads = usable_threads();
    return arguments;
#endif
}

// Initialises Kokkos on the first call, and finalises it when the program exits. If the program has initialised Kokkos
// itself, this function does neither.
void initialize()
{
    struct Runtime {
        bool ours = !Kokkos::is_initialized();
        Runtime()
        {
            if (ours) Kokkos::initialize(settings());
        }
        ~Runtime()
        {
            if (ours && Kokkos::is_initialized()) Kokkos::finalize();
        }
        Runtime(const Runtime&) = delete;
        Runtime& operator=(const Runtime&) = delete;
    };
    static const Runtime runtime;
}

class InKokkos : public job::Model {
public:
    std::string_view name() const override { return "kokkos"; }
    BackendInfo info() const override
    {
        return {.title = "Kokkos",
                .distribution = "the model's own loop over the pixels of a band, one after the other in each thread",
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    job::Kernels kernels() const override { return {kokkos::drawing, kokkos::chains}; }

    job::OpenedDevice open(int) const override
    {
        initialize();
        constexpr int version = KOKKOS_VERSION;
        const Device device{.name = cpu_name(),
                            .vendor = cpu_vendor(),
                            .driver = fmt::format("Kokkos {}.{}.{}, {}", version / 10000, version / 100 % 100,
                                                  version % 100, kokkos::Space::name()),
                            .is_gpu = false};
        return {.device = device, .threads = kokkos::Space().concurrency(), .in_cells = true};
    }
};

}  // namespace

std::unique_ptr<Backend> make_kokkos_backend() { return job::backend_of(std::make_unique<InKokkos>()); }

}  // namespace mandelmarch
