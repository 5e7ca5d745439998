// SPDX-License-Identifier: Apache-2.0
// The kernel in packs, which are vectors of pixels, and the scheduler around it. Packs have three widths: narrow packs
// (one SIMD register) fill and empty the pools of rays, packs of two registers shade hits, and wide packs march rays
// and refine hits. Before including this file, define MM_COUNTED (1: packs count work, 0: they do not).

namespace narrow {
#define MM_REGISTERS 1
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"
#include "backends/openmp/packs/rays.h"
#include "backends/openmp/packs/pixels.h"
#include "backends/openmp/packs/drawing.h"
#include "backends/openmp/packs/sharing.h"
#include "backends/openmp/packs/passes.h"
#include "backends/openmp/packs/blocks.h"
#include "backends/openmp/packs/cones.h"
#include "backends/openmp/packs/squares.h"
#include "backends/openmp/packs/begin.h"
#include "backends/openmp/packs/pool.h"
#if MM_COUNTED
#include "backends/openmp/packs/samples.h"
#endif
#ifdef MANDELMARCH_ONE_WIDTH
#include "backends/openmp/packs/shading.h"
#endif
#include "core/kernel/prelude/undefine.h"
#undef MM_REGISTERS
}  // namespace narrow

#ifndef MANDELMARCH_ONE_WIDTH
namespace pair {
#define MM_REGISTERS 2
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"
#include "backends/openmp/packs/rays.h"
#include "backends/openmp/packs/pixels.h"
#include "backends/openmp/packs/shading.h"
#include "core/kernel/prelude/undefine.h"
#undef MM_REGISTERS
}  // namespace pair

// In packs of four registers, operations on one register hide the latency of those on another, although some registers
// are spilled to memory. A fractal can select fewer.
namespace wide {
#if defined(MM_WIDE_REGISTERS_AVX3) && HWY_TARGET <= HWY_AVX3
#define MM_REGISTERS MM_WIDE_REGISTERS_AVX3
#else
#define MM_REGISTERS 4
#endif
#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"
#include "backends/openmp/packs/rays.h"
#include "backends/openmp/packs/samples.h"
#include "core/kernel/prelude/undefine.h"
#undef MM_REGISTERS
}  // namespace wide
#endif
