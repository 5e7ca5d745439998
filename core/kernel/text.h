// SPDX-License-Identifier: Apache-2.0
// The one kernel text, in its order. Define MM_FRACTAL_FILE, include a prelude, then this: inside a namespace in C++.
// No include guard: a translation unit may hold several specialisations, each in a namespace of its own.
#ifndef FN_SAMPLED  // for preludes that make no difference between an estimator and other functions
#define FN_SAMPLED FN_CALLED
#endif
#include "core/kernel/scene.h"
#ifdef MM_SCENE_BY_REFERENCE
#define Scene const Scene&
#endif
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "core/kernel/hull.h"
// For fractals that define them.
#undef MM_WIDE_REGISTERS_AVX3
#undef MM_LANES_WAIT
#include MM_FRACTAL_FILE
#include "core/kernel/stepping.h"
#include "core/kernel/camera.h"
#include "core/kernel/march.h"
#include "core/kernel/refine.h"
#include "core/kernel/looks.h"
#include "core/kernel/shade.h"
#undef Scene
#undef FN_SAMPLED
