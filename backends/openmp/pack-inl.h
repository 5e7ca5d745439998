// SPDX-License-Identifier: Apache-2.0
// The kernel in packs, used by the sections of the renderer (*-inl.h). A section is compiled once per instruction set
// and kind of pack. It opens its own namespaces, includes what it uses, and can be included alone and in any order.
// end_pack.h removes its guard at the end of a pack.
//
// Define MM_REAL, MM_REAL_IS_FLOAT, MM_FAST and MM_FRACTAL_FILE; and for each pack MM_PACK (its namespace),
// MM_REGISTERS (registers per pack) and MM_COUNTED (1 or 0: count work).

// Include guard for one pack; end_pack.h removes it.
#ifndef MM_PACK_INL_H
#define MM_PACK_INL_H

#include "hwy/highway.h"

// Defaults for a section that is included alone, as by an editor.
#ifndef MM_PACK
#define MM_PACK counted::narrow
#define MM_REGISTERS 1
#define MM_COUNTED 1
#endif

// A lambda that is not inlined costs more than its body.
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
