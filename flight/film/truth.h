// SPDX-License-Identifier: Apache-2.0
// Whether frames are true: how far they are off from pictures whose rays take steps so short that shorter ones change
// nothing.
#pragma once

#include <vector>

#include "core/render/backend.h"
#include "flight/audit/audit.h"
#include "flight/film/frames.h"

namespace mandelmarch {

// The share of a frame's pixels that are visibly off, in percent, of every hundredth frame: three promises, its median,
// the share that 95 of 100 frames keep, and the worst. Of each frame sixteen places spread over it are drawn, as the
// film draws them and once more by short steps alone. Throws what the renderer throws.
std::vector<Row> truth_rows(const Path& path, const Backend& backend, const RendererOptions& options,
                            const Picture& picture);

}  // namespace mandelmarch
