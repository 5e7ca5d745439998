// SPDX-License-Identifier: Apache-2.0
// The kernel on packs, which are vectors of pixels, one or more SIMD registers wide. The renderer's sections (the files
// *-inl.h) use it. Each section is compiled once for every instruction set and kind of pack. It opens its own
// namespaces and includes what it uses, so sections can be included in any order. At the end of a pack, end_pack.h
// removes the sections' include guards.
//
// The including file defines MM_REAL, MM_REAL_IS_FLOAT, MM_FAST and MM_FRACTAL_FILE; and for each pack MM_PACK (its
// namespace), MM_REGISTERS (registers per pack) and MM_COUNTED (1: counts work, 0: does not).

// Include guard for one pack; end_pack.h removes it.
#ifndef MM_PACK_INL_H
#define MM_PACK_INL_H

#include "hwy/highway.h"

#if !defined(MM_REAL) || !defined(MM_REAL_IS_FLOAT) || !defined(MM_FAST) || !defined(MM_FRACTAL_FILE)
#error "expected definitions of MM_REAL, MM_REAL_IS_FLOAT, MM_FAST and MM_FRACTAL_FILE"
#endif

// Defaults for a section that is compiled alone, for example by an editor.
#ifndef MM_PACK
#define MM_PACK counted::narrow
#define MM_REGISTERS 1
#define MM_COUNTED 1
#endif

// Forces a lambda to be inlined; its call would cost more than its body.
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
