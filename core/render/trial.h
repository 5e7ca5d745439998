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
    double stride = 0;  // in which the picture is drawn, as Scene::stride
    double off = 0;     // the share of the trial's pixels that shorter steps still changed visibly; 0: none were tried

    bool settled() const;  // shorter steps would change little
};

// Which stride of fast mode draws the scene: its own where the shorter one of 0.4, 0.2 and 0.1 that comes next shows
// the same picture but for a few pixels, else the first of these of which that is true; its own again where shorter
// steps bring pictures no nearer to each other, as digits are short. `draw` draws a small picture.
Trial try_steps(const Scene& scene, const std::function<void(const Scene&, Image&)>& draw);

// Whether a trial goes before a picture that is drawn so.
bool is_tried(const RendererOptions& options);

// The trial that the backend would make before the picture.
Trial try_steps(const Scene& scene, const Backend& backend, RendererOptions options);

// The backend, with a trial before each picture of fast mode. Timings include the trial's; Work does not.
std::unique_ptr<Backend> with_trials(std::unique_ptr<Backend> backend);

}  // namespace mandelmarch
