// SPDX-License-Identifier: Apache-2.0
// loop() calls body(0) to body(count - 1) in parallel, with Kokkos on the host.
#pragma once

#include <Kokkos_Core.hpp>

namespace mandelmarch::kokkos {

using Space = Kokkos::DefaultHostExecutionSpace;

template <class Body>
void loop(int count, Body body)
{
    Kokkos::parallel_for(Kokkos::RangePolicy<Space, Kokkos::Schedule<Kokkos::Dynamic>>(0, count), body);
    Kokkos::fence();
}

}  // namespace mandelmarch::kokkos
