// SPDX-License-Identifier: Apache-2.0
// The kernel text in packs: what the parts around it (*-inl.h) are written in. A part is compiled once for each
// instruction set and for each kind of pack; it opens its namespaces itself, includes what it uses, and can be included
// alone and in any order. end_pack.h takes its guard away when a pack ends.
//
// Define MM_REAL, MM_REAL_IS_FLOAT, MM_FAST and MM_FRACTAL_FILE; and for each pack MM_PACK, its namespace,
// MM_REGISTERS, the registers of a pack, and MM_COUNTED, 1 or 0: whether work is counted.

// Guard: once for each pack (end_pack.h).
#ifndef MM_PACK_INL_H
#define MM_PACK_INL_H

#include "hwy/highway.h"

// A part that is opened alone.
#ifndef MM_PACK
#define MM_PACK counted::narrow
#define MM_REGISTERS 1
#define MM_COUNTED 1
#endif

// Lambdas that stay calls cost more than what they do.
#define MM_INLINED __attribute__((always_inline)) HWY_ATTR

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

#include "core/kernel/prelude/pack.h"
#include "core/kernel/text.h"

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
