// Fast mode's steps pass through the surface where the estimate is too large or jumps (docs/design.md). How often they
// do in a scene a trial tells: the scene in about a thousand pixels, with those steps and with shorter ones.
#pragma once

#include <functional>
#include <memory>

#include "core/render/backend.h"

namespace mandelmarch {

// The stride of fast mode in which the scene can be drawn: the scene's own where the shorter one of 0.4, 0.2, 0.1 that
// comes next shows the same picture but for a few pixels, else the first of these of which that is true; the scene's
// own again where shorter steps bring no two pictures nearer, as digits are short. `draw` draws a small picture.
double tried_stride(const Scene& scene, const std::function<void(const Scene&, Image&)>& draw);

// The backend, with a trial before each picture of fast mode. Timings include the trial's; Work does not.
std::unique_ptr<Backend> with_trials(std::unique_ptr<Backend> backend);

}  // namespace mandelmarch
