// SPDX-License-Identifier: Apache-2.0
// What can be drawn, and what is drawn, as JSON: the fractals with their formulas, and a scene as the kernel text takes
// it. The report's viewer computes with the one and is checked against the other (docs/report-internals.md).
#pragma once

#include <string>

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch {

// {"scene": what holds of every scene, "fractals": [a row each, in their order]}. Formulas are texts, as
// core/scene/formula.h writes them, of shape[0] to shape[2], escape, iterations and largest.
std::string fractals_json();

// A line for each fractal and each of its numbers.
std::string fractals_text();

// The kernel text's Scene by field, without tails, which packs alone make. Throws InputError as kernel_scene() does.
std::string scene_json(const Scene& scene, const RendererOptions& options);

}  // namespace mandelmarch
