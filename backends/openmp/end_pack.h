// SPDX-License-Identifier: Apache-2.0
// Included at the end of a pack: removes the pack's macros and the include guards of its sections, so that another pack
// can follow. Has no include guard.

#undef MM_BEGIN_INL_H
#undef MM_BLOCKS_INL_H
#undef MM_CONES_INL_H
#undef MM_DRAWING_INL_H
#undef MM_PACK_INL_H
#undef MM_PASSES_INL_H
#undef MM_PIXELS_INL_H
#undef MM_POOL_INL_H
#undef MM_PROFILE_INL_H
#undef MM_RAYS_INL_H
#undef MM_SAMPLES_INL_H
#undef MM_SHADING_INL_H
#undef MM_SHARING_INL_H
#undef MM_SQUARES_INL_H

#include "core/kernel/prelude/undefine.h"
#undef MM_APPEND
#undef MM_INLINED
#undef MM_COUNTED
#undef MM_REGISTERS
#undef MM_PACK
