// SPDX-License-Identifier: Apache-2.0
// Convergence of a film's frames: their difference from converged pictures, whose steps are so short that shorter ones
// change nothing.
#pragma once

#include <vector>

#include "core/render/backend.h"
#include "flight/audit/audit.h"
#include "flight/film/frames.h"

namespace mandelmarch {

// Returns three promises about the percentage of a frame's pixels that differ visibly from the converged picture: its
// median, its 95th percentile and its maximum over every hundredth frame. Of each frame, sixteen patches are rendered,
// once as in the film and once with short steps. Throws as the renderer does.
std::vector<Row> truth_rows(const Path& path, const Backend& backend, const RendererOptions& options,
                            const Picture& picture);

}  // namespace mandelmarch
