// SPDX-License-Identifier: Apache-2.0
// How long the steps of a picture's rays are, and how near a hit comes to the surface: what is decided before a picture
// is drawn. core/kernel/stepping.h decides from sample to sample. docs/fast-mode.md has all constants of both.
#pragma once

#include <array>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

struct Stepping {
    double stride;      // of a plain step, in distance estimates
    double relaxation;  // of the longest over-relaxed step, in distance estimates; the stride: no step is over-relaxed
    double root_share;  // of a hit: the most that |DE - tolerance t| is, in tolerances
};

// The longest over-relaxed step, in distance estimates: chosen by how far pictures change (docs/notes/experiments.md).
inline constexpr double longest_relaxed = 1.7;

// The strides that a trial tries, in distance estimates (core/render/trial.h).
inline constexpr std::array shorter_strides{0.4, 0.2, 0.1};

// The root share of a film, in tolerances: docs/notes/experiments.md.
inline constexpr double film_root_share = 0.01;

// The root share where hits are not refined, in tolerances: more than any sample is off.
inline constexpr double any_root_share = 1e9;

// What a picture of the scene is drawn with.
// exact: plain steps. fast: the fractal's own (Fractal::fast), over-relaxed unless they are shorter than plain ones.
// The scene's limits hold in both modes.
Stepping stepping_of(const Scene& scene, Mode mode, const Techniques& techniques = {});

// What the frame of a film asks for beside the scene's own limits: short steps, as the fractal fills the picture.
StepLimits film_limits(const Scene& scene);

}  // namespace mandelmarch
