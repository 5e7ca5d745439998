// SPDX-License-Identifier: Apache-2.0
// Sets the step lengths and the accuracy of hits for a whole picture. core/kernel/stepping.h uses them to choose each
// step.
#pragma once

#include <array>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

struct Stepping {
    double step_factor;  // length of a step without over-relaxation, as a multiple of the estimate
    double relaxation;   // max length of an over-relaxed step, in estimates; equal to step_factor: no over-relaxation
    double root_share;   // max |DE - tolerance t| at a hit, in tolerances
};

// Max length of an over-relaxed step, as a multiple of the estimate. Chosen by measuring how much pictures change
// (docs/notes/experiments.md).
inline constexpr double longest_relaxed = 1.7;

// The shorter step factors that a trial tests (core/render/trial.h), in this order.
inline constexpr std::array shorter_step_factors{0.4, 0.2, 0.1};

// root_share for films (docs/notes/experiments.md).
inline constexpr double film_root_share = 0.01;

// root_share for pictures without refinement. It exceeds the error of any sample.
inline constexpr double any_root_share = 1e9;

// Returns the stepping for a picture of the scene. In exact mode it is the original stepping. In fast mode it is the
// fractal's step factor (Fractal::fast), with over-relaxation unless that factor is below plain_step_factor. The
// scene's own limits apply in both modes.
Stepping stepping_of(const Scene& scene, Mode mode, const Techniques& techniques = {});

// Returns the scene's limits, combined with the limits for the frames of a film. Steps are shorter, because in a film
// the camera is so close that the fractal fills the picture.
StepLimits film_limits(const Scene& scene);

}  // namespace mandelmarch
