// SPDX-License-Identifier: Apache-2.0
#include "core/render/stepping.h"

#include <algorithm>

#include "core/scene/fractal.h"

namespace mandelmarch {

Stepping stepping_of(const Scene& scene, Mode mode, const Techniques& techniques)
{
    const Fractal& fractal = *scene.fractal;
    const bool fast = mode == Mode::fast;
    const double step_factor =
        std::min(scene.limits.step_factor, fast ? fractal.fast.step_factor.value(inputs_of(scene)) : plain_step_factor);
    // Scenes that need short steps are rendered without over-relaxation.
    const bool relaxed = fast && techniques.relaxation && step_factor >= plain_step_factor;
    return {.step_factor = step_factor,
            .relaxation = relaxed ? longest_relaxed : step_factor,
            .root_share =
                techniques.refinement ? std::max(scene.limits.root_share, fractal.fast.root_share) : any_root_share};
}

StepLimits film_limits(const Scene& scene)
{
    return {.step_factor = std::min(scene.limits.step_factor, scene.fractal->flight.trust_of(scene).step_factor),
            .root_share = std::max(scene.limits.root_share, film_root_share)};
}

}  // namespace mandelmarch
