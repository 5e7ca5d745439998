// SPDX-License-Identifier: Apache-2.0
// The body of every packs_*.cpp, included once for each instruction set: its variants in packs. Each pack below says
// what it is, includes its parts and ends: packs of one register with the pools, and wide packs, which take samples for
// them.

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
#include "backends/openmp/end_pack.h"

#ifndef MANDELMARCH_ONE_WIDTH
// Four registers hide the arithmetic's latency, at the price of some spilled values; a fractal can ask for less in fast
// mode.
#undef MM_WIDE_REGISTERS
#if MM_FAST && defined(MM_WIDE_REGISTERS_FAST) && HWY_TARGET <= HWY_AVX3
#define MM_WIDE_REGISTERS MM_WIDE_REGISTERS_FAST
#else
#define MM_WIDE_REGISTERS 4
#endif

#define MM_PACK counted::wide
#define MM_REGISTERS MM_WIDE_REGISTERS
#define MM_COUNTED 1
#include "backends/openmp/samples-inl.h"
#include "backends/openmp/end_pack.h"

// Counting takes some percent of a fast picture's time.
#if MM_FAST
#define MM_PACK uncounted::narrow
#define MM_REGISTERS 1
#define MM_COUNTED 0
#include "backends/openmp/pool-inl.h"
#include "backends/openmp/profile-inl.h"
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
// Without vectors the scalar text runs.
HWY_MAYBE_UNUSED VariantList<MM_REAL> list() { return {}; }
#else

#ifdef MANDELMARCH_ONE_WIDTH
namespace best_pools = counted::narrow;
namespace best_samples = counted::narrow;
#elif MM_FAST
namespace best_pools = uncounted::narrow;
namespace best_samples = uncounted::wide;
#else
namespace best_pools = counted::narrow;
namespace best_samples = counted::wide;
#endif

// The best last.
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
    add(counted::narrow::pack_lanes, true, counted::narrow::draw<counted::narrow::width>);
#ifndef MANDELMARCH_ONE_WIDTH
    add(counted::wide::pack_lanes, true, counted::narrow::draw<counted::wide::width>);
#if MM_FAST
    add(uncounted::narrow::pack_lanes, false, uncounted::narrow::draw<uncounted::narrow::width>);
    add(uncounted::wide::pack_lanes, false, uncounted::narrow::draw<uncounted::wide::width>);
#endif
#endif
    Variant<MM_REAL>& best = variants.of[variants.count - 1];
    best.profile = best_pools::profile<best_samples::width>;
    best.profile_memory = sizeof(best_pools::ProfileMemory);
    return variants;
}
#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
