// SPDX-License-Identifier: Apache-2.0
// The body of every packs.cpp: included once per instruction set by Highway's foreach_target.h. No include guard.

#include "core/kernel/prelude/vectorless.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

#if MM_VECTORLESS
// Without vectors the scalar text runs.
VariantList<MM_REAL> list() { return {}; }
#else

#define MM_COUNTED 1
namespace counted {
#include "backends/openmp/widths.h"
}  // namespace counted
#undef MM_COUNTED

// Counting takes some percent of a fast picture's time.
#if MM_FAST && !defined(MANDELMARCH_ONE_WIDTH)
#define MM_COUNTED 0
namespace uncounted {
#include "backends/openmp/widths.h"
}  // namespace uncounted
#undef MM_COUNTED
#endif

// The best last.
VariantList<MM_REAL> list()
{
    const char* name = hwy::TargetName(HWY_TARGET);
    constexpr std::size_t memory = sizeof(counted::pools::Pools);
    VariantList<MM_REAL> variants{};
    const auto add = [&](int pack, bool counted, DrawTiles<MM_REAL> draw) {
        variants.of[variants.count++] = {name, pack, counted, draw, memory};
    };
    add(counted::pools::pack_lanes, true, counted::draw_narrow);
#ifndef MANDELMARCH_ONE_WIDTH
    add(counted::wide::pack_lanes, true, counted::draw_wide);
#if MM_FAST
    add(uncounted::pools::pack_lanes, false, uncounted::draw_narrow);
    add(uncounted::wide::pack_lanes, false, uncounted::draw_wide);
#endif
#endif
    return variants;
}
#endif

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace mandelmarch::openmp {

HWY_EXPORT(list);

VariantList<MM_REAL> MM_VARIANTS();
VariantList<MM_REAL> MM_VARIANTS() { return HWY_DYNAMIC_DISPATCH(list)(); }

}  // namespace mandelmarch::openmp
#endif
