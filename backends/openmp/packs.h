// SPDX-License-Identifier: Apache-2.0
// The body of every packs_*.cpp, included once per instruction set; defines that set's variants. Each pack below
// defines its parameters, includes its sections, and ends with end_pack.h. The kernel runs in packs of three widths:
// narrow packs (one register) fill and empty the pools of rays, packs of two registers shade hits, and wide packs march
// rays and refine hits.

#include <cstddef>

#include "backends/openmp/variant.h"
#include "backends/openmp/width-inl.h"
#include "core/kernel/prelude/vectorless.h"
#include "hwy/highway.h"

#if !MM_VECTORLESS
#define MM_PACK counted::narrow
#define MM_REGISTERS 1
#define MM_COUNTED 1
#include "backends/openmp/pool-inl.h"
#include "backends/openmp/profile-inl.h"
#include "backends/openmp/samples-inl.h"
#ifdef MANDELMARCH_ONE_WIDTH
#include "backends/openmp/shading-inl.h"
#endif
#include "backends/openmp/end_pack.h"

#ifndef MANDELMARCH_ONE_WIDTH
#define MM_PACK counted::pair
#define MM_REGISTERS 2
#define MM_COUNTED 1
#include "backends/openmp/shading-inl.h"
#include "backends/openmp/end_pack.h"

// In packs of four registers, operations on one register hide the latency of those on another, although some registers
// are spilled to memory. A fractal can select fewer.
#undef MM_WIDE_REGISTERS
#if defined(MM_WIDE_REGISTERS_AVX3) && HWY_TARGET <= HWY_AVX3
#define MM_WIDE_REGISTERS MM_WIDE_REGISTERS_AVX3
#else
#define MM_WIDE_REGISTERS 4
#endif

#define MM_PACK counted::wide
#define MM_REGISTERS MM_WIDE_REGISTERS
#define MM_COUNTED 1
#include "backends/openmp/samples-inl.h"
#include "backends/openmp/end_pack.h"

// Packs that do not count their work, because counting takes a few percent of a fast picture's time.
#if MM_FAST
#define MM_PACK uncounted::narrow
#define MM_REGISTERS 1
#define MM_COUNTED 0
#include "backends/openmp/pool-inl.h"
#include "backends/openmp/profile-inl.h"
#include "backends/openmp/end_pack.h"

#define MM_PACK uncounted::pair
#define MM_REGISTERS 2
#define MM_COUNTED 0
#include "backends/openmp/shading-inl.h"
#include "backends/openmp/end_pack.h"

#define MM_PACK uncounted::wide
#define MM_REGISTERS MM_WIDE_REGISTERS
#define MM_COUNTED 0
#include "backends/openmp/samples-inl.h"
#include "backends/openmp/end_pack.h"
#endif
#endif
#endif

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

#if MM_VECTORLESS
// For an instruction set without vectors there are no packs; the scalar kernel is used.
HWY_MAYBE_UNUSED VariantList<MM_REAL> list() { return {}; }
#else

#ifdef MANDELMARCH_ONE_WIDTH
namespace best = counted;
namespace best_samples = best::narrow;
namespace best_shading = best::narrow;
#else
#if MM_FAST
namespace best = uncounted;
#else
namespace best = counted;
#endif
namespace best_samples = best::wide;
namespace best_shading = best::pair;
#endif

// Returns the variants for this instruction set. The best one is last.
HWY_MAYBE_UNUSED VariantList<MM_REAL> list()
{
    const char* name = hwy::TargetName(HWY_TARGET);
    VariantList<MM_REAL> variants{};
    const auto add = [&](int pack, bool counted, DrawTiles<MM_REAL> draw) {
        variants.of[variants.count++] = {.instruction_set = name,
                                         .pack = pack,
                                         .counted = counted,
                                         .draw = draw,
                                         .memory = sizeof(counted::narrow::Pools)};
    };
#ifdef MANDELMARCH_ONE_WIDTH
    add(counted::narrow::pack_lanes, true, counted::narrow::draw<counted::narrow::sampling, counted::narrow::shading>);
#else
    add(counted::narrow::pack_lanes, true, counted::narrow::draw<counted::narrow::sampling, counted::pair::shading>);
    add(counted::wide::pack_lanes, true, counted::narrow::draw<counted::wide::sampling, counted::pair::shading>);
#if MM_FAST
    add(uncounted::wide::pack_lanes, false,
        uncounted::narrow::draw<uncounted::wide::sampling, uncounted::pair::shading>);
#endif
#endif
    Variant<MM_REAL>& best_variant = variants.of[variants.count - 1];
    best_variant.profile = best::narrow::profile<best_samples::sampling, best_shading::shading>;
    best_variant.profile_memory = sizeof(best::narrow::ProfileMemory);
    return variants;
}
#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
