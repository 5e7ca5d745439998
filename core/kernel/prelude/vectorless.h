// SPDX-License-Identifier: Apache-2.0
// MM_VECTORLESS is not 0 for Highway's targets for which no packs are compiled: its fallback for machines without
// vectors, whose name differs between g++ and clang++, and SSE2, which newer versions of Highway place below SSE4.
#pragma once

#ifdef HWY_SSE2
#define MM_VECTORLESS (HWY_TARGET & (HWY_SCALAR | HWY_EMU128 | HWY_SSE2))
#else
#define MM_VECTORLESS (HWY_TARGET & (HWY_SCALAR | HWY_EMU128))
#endif
