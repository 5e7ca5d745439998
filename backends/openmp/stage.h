// SPDX-License-Identifier: Apache-2.0
// Stages of a picture rendered by openmp, in the order of the kernel source.
#pragma once

namespace mandelmarch::openmp {

enum class Stage { begin, march, refine, normal, shade, output };
inline constexpr int stages = 6;

}  // namespace mandelmarch::openmp
