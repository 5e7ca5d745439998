// SPDX-License-Identifier: Apache-2.0
// Step lengths and accuracy of hits for a picture. core/kernel/stepping.h decides from sample to sample.
// docs/fast-mode.md lists the constants of both.
#pragma once

#include <array>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

struct Stepping {
    double step_factor;  // of a step without over-relaxation, in distance estimates
    double relaxation;   // of the longest over-relaxed step, in distance estimates; equal to stride: no over-relaxation
    double root_share;   // max |DE - tolerance t| of a hit, in tolerances
};

// Max over-relaxed step, in distance estimates. Chosen by the changes of pictures (docs/notes/experiments.md).
inline constexpr double longest_relaxed = 1.7;

// Step factors tested by a trial (core/render/trial.h).
inline constexpr std::array shorter_step_factors{0.4, 0.2, 0.1};

// root_share of films: docs/notes/experiments.md.
inline constexpr double film_root_share = 0.01;

// root_share without refinement: larger than the error of any sample.
inline constexpr double any_root_share = 1e9;

// Returns the stepping for a picture of the scene.
// exact: original stepping. fast: the fractal's step factor (Fractal::fast), over-relaxed unless below
// plain_step_factor. The scene's limits apply in both modes.
Stepping stepping_of(const Scene& scene, Mode mode, const Techniques& techniques = {});

// Returns the additional limits of a film's frame: short steps, as the fractal fills the picture.
StepLimits film_limits(const Scene& scene);

}  // namespace mandelmarch
