// SPDX-License-Identifier: Apache-2.0
// Highway targets without pack kernels: its fallback for machines without vectors (named differently with g++ and with
// clang++), and SSE2, which newer versions of Highway place below SSE4.
#pragma once

#ifdef HWY_SSE2
#define MM_VECTORLESS (HWY_TARGET & (HWY_SCALAR | HWY_EMU128 | HWY_SSE2))
#else
#define MM_VECTORLESS (HWY_TARGET & (HWY_SCALAR | HWY_EMU128))
#endif
