// SPDX-License-Identifier: Apache-2.0
// JSON for the report's viewer (docs/report.md). fractals_json() lists all fractals with their formulas,
// which the viewer uses. scene_json() describes a scene as kernels receive it; tests compare it with the scene that the
// viewer computes.
#pragma once

#include <string>

#include "core/render/backend.h"
#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// Returns the slider for a parameter whose official value is given. If the fractal's descriptor does not set one, the
// slider covers values around the official one.
ParameterInfo::Slider slider_of(const ParameterInfo& meaning, double official);

// Returns {"scene": constants of all scenes, "fractals": [one object per fractal]}. Formulas are strings as written by
// core/scene/formula.h; their variables are shape[0] to shape[2], escape, iterations, largest and conservative.
std::string fractals_json();

// Returns a list of the fractals and their parameters as text for the user.
std::string fractals_text();

// Returns the fields of the kernel's Scene as JSON. The technique `tail` is disabled, because only packs support it.
// Throws InputError as kernel_scene() does.
std::string scene_json(const Scene& scene, const RendererOptions& options);

}  // namespace mandelmarch
