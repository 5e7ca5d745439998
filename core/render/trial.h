// SPDX-License-Identifier: Apache-2.0
// Trial renders. In fast mode steps pass through the surface where the estimate is too large or discontinuous
// (docs/fast-mode.md). A trial measures how often: it renders about a thousand pixels with those steps and with shorter
// ones.
#pragma once

#include <functional>
#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

// Result of a trial.
struct Trial {
    double step_factor = 0;  // step factor for the picture
    double off = 0;          // fraction of the trial's pixels that shorter steps still change visibly; 0: none tested

    bool settled() const;  // true if shorter steps would change little
};

// Returns the scene in about a thousand pixels.
Scene trial_scene(const Scene& scene);

// Returns the step factor of fast mode for the scene. `draw` renders a small picture. The usual factor is compared with
// the next of shorter_step_factors (core/render/stepping.h):
// 1. The pictures differ in a few pixels at most: the longer steps are used.
// 2. They differ in more: the shorter steps are compared with the next ones.
// 3. The differences do not shrink: the precision is the limit, and the usual factor is kept.
Trial try_steps(const Scene& scene, const std::function<void(const Scene&, Image&)>& draw);

// True if a picture with these options is preceded by a trial.
bool is_tried(const RendererOptions& options);

// Runs the trial that the backend would run before the picture.
Trial try_steps(const Scene& scene, const Backend& backend, RendererOptions options);

// Returns the backend with a trial before each fast picture. Timings include the trial; Work does not.
std::unique_ptr<Backend> with_trials(std::unique_ptr<Backend> backend);

}  // namespace mandelmarch
