// SPDX-License-Identifier: Apache-2.0
// The scalar kernel, compiled in double for every fractal and in float for the Mandelbox. The estimators are not
// inlined, which saves a minute of build time under sanitizers. A source that includes this header cannot be part of a
// unity build.
#pragma once

#include <cstring>

#include "core/render/kernel_scene.h"

#define MM_REAL double
#define MM_REAL_IS_FLOAT 0
#define MM_FRACTAL_FILE "core/kernel/fractals/mandelbulb.h"
namespace bulb64 {
#define FN_CALLED inline
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/text.h"
#include "core/kernel/prelude/undefine.h"
}  // namespace bulb64
#undef MM_FRACTAL_FILE
#define MM_FRACTAL_FILE "core/kernel/fractals/julia.h"
namespace julia64 {
#define FN_CALLED inline
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/text.h"
#include "core/kernel/prelude/undefine.h"
}  // namespace julia64
#undef MM_FRACTAL_FILE
#define MM_FRACTAL_FILE "core/kernel/fractals/mandelbox.h"
namespace box64 {
#define FN_CALLED inline
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/text.h"
#include "core/kernel/prelude/undefine.h"
}  // namespace box64
#undef MM_REAL
#undef MM_REAL_IS_FLOAT
#define MM_REAL float
#define MM_REAL_IS_FLOAT 1
namespace box32 {
#define FN_CALLED inline
#include "core/kernel/prelude/scalar.h"
#include "core/kernel/text.h"
#include "core/kernel/prelude/undefine.h"
}  // namespace box32

namespace mandelmarch {

// Returns the scene in the form that a kernel of this test reads.
template <class KernelScene>
KernelScene scene_for_kernel(const Scene& scene, Mode mode = Mode::exact, const Techniques& techniques = {})
{
    const auto from = kernel_scene<layout_f64::Scene>(scene, mode, techniques);
    static_assert(sizeof(KernelScene) == sizeof(from));
    KernelScene to;
    std::memcpy(&to, &from, sizeof(to));
    return to;
}

}  // namespace mandelmarch
