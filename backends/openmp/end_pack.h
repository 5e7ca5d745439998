// SPDX-License-Identifier: Apache-2.0
// Ends a pack: takes its words away and turns the guards of its parts, so that the parts of another pack can follow. No
// guard: it acts each time.

// Pools handle one register at a time.
#if MM_REGISTERS == 1
#ifdef MM_POOL_TOGGLE
#undef MM_POOL_TOGGLE
#else
#define MM_POOL_TOGGLE
#endif
#endif

#ifdef MM_PACK_TOGGLE
#undef MM_PACK_TOGGLE
#else
#define MM_PACK_TOGGLE
#endif

#include "core/kernel/prelude/undefine.h"
#undef MM_APPEND
#undef MM_INLINED
#undef MM_COUNTED
#undef MM_REGISTERS
#undef MM_PACK
