// SPDX-License-Identifier: Apache-2.0
// The kokkos backend: the kernel in a Kokkos::parallel_for, in the default host space of Kokkos.
#pragma once

#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

std::unique_ptr<Backend> make_kokkos_backend();

}  // namespace mandelmarch
