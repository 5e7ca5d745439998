// SPDX-License-Identifier: Apache-2.0
// What a film or a still is made of, so that a finished one is known again.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/render/backend.h"
#include "flight/film/frames.h"
#include "flight/path/path.h"

namespace mandelmarch {

// Everything that the pixels of a path's pictures depend on, the program included, and `more`, names with values: one
// line of JSON. Another build may draw other bits: its pictures are not mixed with these.
std::string description_of(const Path& path, const Backend& backend, const Picture& picture,
                           const RendererOptions& renderer,
                           const std::vector<std::pair<std::string, std::string>>& more);

// The differences of two such descriptions, in words: "instructions: 'SCALAR', here 'AVX2'; ...", where `here` is the
// second. Empty if they are equal.
std::string differences(const std::string& theirs, const std::string& ours);

}  // namespace mandelmarch
