// SPDX-License-Identifier: Apache-2.0
// MM_VECTORLESS is not 0 if Highway's present target is one for which no packs are compiled. There are two such
// targets: Highway's fallback for machines without vectors, whose name differs between g++ and clang++, and SSE2, a
// target below SSE4 that only newer versions of Highway have.
#pragma once

#ifdef HWY_SSE2
#define MM_VECTORLESS (HWY_TARGET & (HWY_SCALAR | HWY_EMU128 | HWY_SSE2))
#else
#define MM_VECTORLESS (HWY_TARGET & (HWY_SCALAR | HWY_EMU128))
#endif
