// The body of every packs.cpp: included once per instruction set by Highway's foreach_target.h. No include guard.

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

#define MM_REGISTERS 1
namespace registers_1 {
#include "backends/openmp/pool.h"
}
#undef MM_REGISTERS
#if MANDELMARCH_ALL_PACKS
#define MM_REGISTERS 4
namespace registers_4 {
#include "backends/openmp/pool.h"
}
#undef MM_REGISTERS
#endif

#define MM_VARIANT(pack)                                                                     \
    {                                                                                        \
        hwy::TargetName(HWY_TARGET), pack::pack_lanes, pack::draw_tiles, sizeof(pack::Pools) \
    }

// The best last: four independent registers hide the arithmetic's latency, at the price of some spilled values.
VariantList<MM_REAL> list()
{
#if MANDELMARCH_ALL_PACKS
    return {{MM_VARIANT(registers_1), MM_VARIANT(registers_4)}, 2};
#else
    return {{MM_VARIANT(registers_1)}, 1};
#endif
}
#undef MM_VARIANT

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
