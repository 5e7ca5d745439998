// SPDX-License-Identifier: Apache-2.0
#include "core/instruments/loops.h"

#include <fmt/format.h>

#include "core/scene/fractal.h"
#include "core/text/error.h"

namespace mandelmarch {

Loops loops_of(const Scene& scene)
{
    CountLoops* const count = loop_counter(scene.fractal->name);
    if (count == nullptr) throw Unavailable(fmt::format("no loops are counted for the {}", scene.fractal->name));
    return count(kernel_scene<layout_f64::Scene>(scene, Mode::exact));
}

}  // namespace mandelmarch
