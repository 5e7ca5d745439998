// SPDX-License-Identifier: Apache-2.0
// JSON of all fractals with their formulas, and of a scene as passed to kernels. The report's viewer uses the former
// and is tested against the latter (docs/report-internals.md).
#pragma once

#include <string>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// Returns {"scene": constants of all scenes, "fractals": [one object per fractal]}. Formulas are strings, as
// core/scene/formula.h writes them, in shape[0] to shape[2], escape, iterations and largest.
std::string fractals_json();

// Returns a list of the fractals and their parameters, for people.
std::string fractals_text();

// Returns the fields of the kernel's Scene. The technique `tail` is off, as only packs support it. Throws InputError as
// kernel_scene() does.
std::string scene_json(const Scene& scene, const RendererOptions& options);

}  // namespace mandelmarch
