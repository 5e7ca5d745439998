// SPDX-License-Identifier: Apache-2.0
// The body of every packs_*.cpp, included once per instruction set. Defines the variants for the instruction set. The
// including file defines MM_REAL, MM_REAL_IS_FLOAT, MM_FAST and MM_FRACTAL_FILE.
//
// Like the kernel source, the files of packs/ have no include guards: packs/kernel.h includes them in order, several
// times, each time in another namespace and for another kind of pack.

// Forces a lambda to be inlined, because a call would cost more than the lambda's body.
#undef MM_INLINED
#define MM_INLINED __attribute__((always_inline)) HWY_ATTR

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

#if MM_VECTORLESS
// For an instruction set without vectors there are no packs; the scalar kernel is used.
HWY_MAYBE_UNUSED VariantList<MM_REAL> list() { return {}; }
#else
#include "backends/openmp/packs/widths.h"

namespace counted {
#define MM_COUNTED 1
#include "backends/openmp/packs/kernel.h"
#undef MM_COUNTED
}  // namespace counted

#if MM_FAST && !defined(MANDELMARCH_ONE_WIDTH)
// Packs that do not count their work, because counting takes a few percent of a fast picture's time.
namespace uncounted {
#define MM_COUNTED 0
#include "backends/openmp/packs/kernel.h"
#undef MM_COUNTED
}  // namespace uncounted
#endif

// Returns the variants for this instruction set. The best one is last.
HWY_MAYBE_UNUSED VariantList<MM_REAL> list()
{
    const char* name = hwy::TargetName(HWY_TARGET);
    VariantList<MM_REAL> variants{};
    const auto add = [&](int pack, bool counts, DrawTiles<MM_REAL> draw) {
        variants.of[variants.count++] = {.instruction_set = name,
                                         .pack = pack,
                                         .counted = counts,
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
    return variants;
}
#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
