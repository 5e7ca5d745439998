// SPDX-License-Identifier: Apache-2.0
// Convergence of a film's frames: how far they differ from converged pictures. A converged picture is rendered with
// steps so short that shorter ones would not change it.
#pragma once

#include <vector>

#include "core/render/backend.h"
#include "flight/audit/audit.h"
#include "flight/film/frames.h"

namespace mandelmarch {

// Measures, at every hundredth frame, the percentage of pixels that differ visibly from the converged picture. Returns
// three promises: the median, the 95th percentile and the maximum over these frames. Sixteen patches of each frame are
// rendered twice without shared occlusion: with the film's steps and with short steps. Throws as the renderer does.
std::vector<Row> truth_rows(const Path& path, const Backend& backend, const RendererOptions& options,
                            const Picture& picture);

}  // namespace mandelmarch
