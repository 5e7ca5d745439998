// SPDX-License-Identifier: Apache-2.0
// Trial renders. In fast mode, steps can pass through the surface where the estimate is too large or discontinuous
// (docs/fast-mode.md). A trial measures how often this happens: before the picture, it renders about a thousand pixels
// with the usual steps and with shorter ones. Backend::create() adds it, unless the scene has been tried
// (StepLimits::tried). The picture's Timings include the trial; its Work does not.
#pragma once

#include <functional>

#include "core/render/backend.h"

namespace mandelmarch {

// Result of a trial.
struct Trial {
    double step_factor = 0;  // the step factor to use for the picture
    double off = 0;          // fraction of the trial's pixels that shorter steps change visibly; 0: none tried
    bool settled() const;    // true if shorter steps would change few pixels
};

// Returns the scene, reduced to about a thousand pixels.
Scene trial_scene(const Scene& scene);

// Returns the step factor that fast mode should use for the scene. `draw` renders a small picture. Begins with the
// usual step factor, and compares its picture with the picture of the next shorter one (shorter_step_factors in
// stepping.h):
// 1. If few pixels differ, the longer steps are used.
// 2. If more differ, the shorter steps become the longer ones of the next comparison.
// 3. If the number of differing pixels does not decrease, the precision is the cause, and the usual factor is used.
Trial try_steps(const Scene& scene, const std::function<void(Renderer::SmallPicture&)>& draw);

// Returns true if a picture with these options is preceded by a trial.
bool is_tried(const RendererOptions& options);

// Runs the trial that the backend would run before the picture with these options.
Trial try_steps(const Scene& scene, const Backend& backend, RendererOptions options);

}  // namespace mandelmarch
