// SPDX-License-Identifier: Apache-2.0
// Highway's fallback for machines without vectors, its name with g++ and with clang++. Packs are not compiled for it.
#pragma once

#define MM_VECTORLESS (HWY_TARGET & (HWY_SCALAR | HWY_EMU128))
