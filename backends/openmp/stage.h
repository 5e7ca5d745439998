// SPDX-License-Identifier: Apache-2.0
// The stages of a picture by openmp, in the order of the text.
#pragma once

namespace mandelmarch::openmp {

enum class Stage { begin, march, refine, normal, shade, output };
inline constexpr int stages = 6;

}  // namespace mandelmarch::openmp
