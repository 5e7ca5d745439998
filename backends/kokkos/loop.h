// SPDX-License-Identifier: Apache-2.0
// The kokkos backend: the kernel in a Kokkos::parallel_for, in the default host space of Kokkos.
#pragma once

#include <fmt/format.h>

#include <Kokkos_Core.hpp>

#include "core/models/host.h"

namespace mandelmarch::kokkos {

// Initialises Kokkos with as many threads as the process may use; Kokkos prefers KOKKOS_NUM_THREADS, if it is set.
// Finalises it when the program exits. Does neither if the program has initialised Kokkos itself.
struct Runtime {
    bool ours = !Kokkos::is_initialized();
    Runtime()
    {
#if KOKKOS_VERSION >= 30700
        if (ours) Kokkos::initialize(Kokkos::InitializationSettings().set_num_threads(usable_threads()));
#else
        Kokkos::InitArguments arguments;
        arguments.num_threads = usable_threads();
        if (ours) Kokkos::initialize(arguments);
#endif
    }
    ~Runtime()
    {
        if (ours && Kokkos::is_initialized()) Kokkos::finalize();
    }
    Runtime(const Runtime&) = delete;
    Runtime& operator=(const Runtime&) = delete;
};

struct Loop : job::HostLoop {
    using Space = Kokkos::DefaultHostExecutionSpace;
    static constexpr std::string_view title = "Kokkos";
    static std::string driver()
    {
        static const Runtime runtime;
        constexpr int version = KOKKOS_VERSION;
        return fmt::format("Kokkos {}.{}.{}, {}", version / 10000, version / 100 % 100, version % 100, Space::name());
    }
    static int threads() { return Space().concurrency(); }

    template <class Body>
    static void run(int count, Body body)
    {
        Kokkos::parallel_for(Kokkos::RangePolicy<Space, Kokkos::Schedule<Kokkos::Dynamic>>(0, count), body);
        Kokkos::fence();
    }
};

}  // namespace mandelmarch::kokkos
