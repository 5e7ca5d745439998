// SPDX-License-Identifier: Apache-2.0
// The whole kernel source, in order. Define MM_FRACTAL_FILE, include a prelude, then this file: in C++ inside a
// namespace. Without an include guard, as a translation unit may hold several specialisations in different namespaces.
#ifndef FN_SAMPLED  // for preludes that treat an estimator as any other function
#define FN_SAMPLED FN_CALLED
#endif
#include "core/kernel/scene.h"
#ifdef MM_SCENE_BY_REFERENCE
#define Scene const Scene&
#endif
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "core/kernel/hull.h"
// Defined by some fractals.
#undef MM_WIDE_REGISTERS_AVX3
#undef MM_REFILL_LANES
#include MM_FRACTAL_FILE
#include "core/kernel/stepping.h"
#include "core/kernel/camera.h"
#include "core/kernel/march.h"
#include "core/kernel/refine.h"
#include "core/kernel/looks.h"
#include "core/kernel/shade.h"
#undef Scene
#undef FN_SAMPLED
