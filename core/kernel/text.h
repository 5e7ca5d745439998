// SPDX-License-Identifier: Apache-2.0
// The whole kernel source, in order. Before including it, define MM_FRACTAL_FILE and include a prelude; in C++ include
// both inside a namespace. Has no include guard, because a translation unit can contain the kernel source several
// times, in different namespaces.
#ifndef FN_SAMPLED  // preludes that treat an estimator like any other function do not define it
#define FN_SAMPLED FN_CALLED
#endif
#include "core/kernel/scene.h"
#ifdef MM_SCENE_BY_REFERENCE
#define Scene const Scene&
#endif
#include "core/kernel/vectors.h"
#include "core/kernel/numbers.h"
#include "core/kernel/hull.h"
// Some fractals define these macros (docs/add-a-fractal.md).
#undef MM_WIDE_REGISTERS_AVX3
#undef MM_HULL_SPAN
#undef MM_SIZE
#undef MM_NO_GRADIENT
#include MM_FRACTAL_FILE
#ifndef MM_HULL_SPAN
#define MM_HULL_SPAN sphere_span
#endif
#ifndef MM_SIZE
#define MM_SIZE R(2.0)
#endif
#include "core/kernel/stepping.h"
#include "core/kernel/camera.h"
#include "core/kernel/march.h"
#include "core/kernel/starts.h"
#include "core/kernel/refine.h"
#include "core/kernel/looks.h"
#include "core/kernel/shade.h"
#undef Scene
#undef FN_SAMPLED
