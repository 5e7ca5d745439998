// SPDX-License-Identifier: Apache-2.0
// Fast mode's steps pass through the surface where the estimate is too large or jumps (docs/fast-mode.md). A trial
// measures how often that happens: it draws the scene in about a thousand pixels, with those steps and with shorter
// ones.
#pragma once

#include <functional>
#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

// What a trial found.
struct Trial {
    double stride = 0;  // of the picture's plain steps, in distance estimates
    double off = 0;     // the share of the trial's pixels that shorter steps still changed visibly; 0: none were tried

    bool settled() const;  // shorter steps would change little
};

// The scene in about a thousand pixels.
Scene trial_scene(const Scene& scene);

// Which stride of fast mode draws the scene. `draw` draws a small picture. The usual stride is compared with the next
// of shorter_strides (core/render/stepping.h):
// 1. The two pictures differ in a few pixels at most: the longer stride is fine.
// 2. They differ in more: the shorter stride is compared with the next one.
// 3. The differences do not shrink: digits are short, and the usual stride is as good as any.
Trial try_steps(const Scene& scene, const std::function<void(const Scene&, Image&)>& draw);

// Whether a trial goes before a picture that is drawn so.
bool is_tried(const RendererOptions& options);

// The trial that the backend would make before the picture.
Trial try_steps(const Scene& scene, const Backend& backend, RendererOptions options);

// The backend, with a trial before each picture of fast mode. Timings include the trial's; Work does not.
std::unique_ptr<Backend> with_trials(std::unique_ptr<Backend> backend);

}  // namespace mandelmarch
