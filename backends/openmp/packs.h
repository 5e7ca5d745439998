// The body of every packs.cpp: included once per instruction set by Highway's foreach_target.h. No include guard.

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

#include "backends/openmp/widths.h"

template <const Width& width>
Spent draw_with(const void* scene, const Canvas<MM_REAL>& canvas, const Tiles& tiles, void* memory)
{
    return pools::draw_tiles(scene, canvas, tiles, memory, width);
}

// The best last.
VariantList<MM_REAL> list()
{
    const char* name = hwy::TargetName(HWY_TARGET);
    constexpr std::size_t memory = sizeof(pools::Pools);
    VariantList<MM_REAL> variants{{{name, pools::pack_lanes, draw_with<pools::width>, memory}}, 1};
#ifndef MANDELMARCH_ONE_WIDTH
    variants.of[variants.count++] = {name, wide::pack_lanes, draw_with<wide::width>, memory};
#endif
    return variants;
}

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
