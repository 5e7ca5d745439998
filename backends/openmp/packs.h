// The body of every packs.cpp: included once per instruction set by Highway's foreach_target.h. No include guard.

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {

#define MM_REGISTERS 2
namespace registers_2 {
#include "backends/openmp/pool.h"
}
#undef MM_REGISTERS
#if MANDELMARCH_ALL_PACKS
#define MM_REGISTERS 1
namespace registers_1 {
#include "backends/openmp/pool.h"
}
#undef MM_REGISTERS
#endif

// The best last: two registers hide most of the latency and leave room for the rest of the state.
VariantList<MM_REAL> list()
{
    const char* name = hwy::TargetName(HWY_TARGET);
#if MANDELMARCH_ALL_PACKS
    return {{{name, registers_1::pack_lanes, registers_1::draw_tiles, sizeof(registers_1::Pools)},
             {name, registers_2::pack_lanes, registers_2::draw_tiles, sizeof(registers_2::Pools)}},
            2};
#else
    return {{{name, registers_2::pack_lanes, registers_2::draw_tiles, sizeof(registers_2::Pools)}}, 1};
#endif
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
