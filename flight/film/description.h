// SPDX-License-Identifier: Apache-2.0
// Descriptions of a film's or still's inputs, by which finished files are recognised.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/render/backend.h"
#include "flight/film/frames.h"
#include "flight/path/path.h"

namespace mandelmarch {

// Returns one line of JSON with everything that the pixels of a path's pictures depend on, and the names and values of
// `more`. It includes the program's digest, because another build may render other bits.
std::string description_of(const Path& path, const Backend& backend, const Picture& picture,
                           const RendererOptions& renderer,
                           const std::vector<std::pair<std::string, std::string>>& more);

// Returns the differences of two descriptions for a message, "instructions: 'SCALAR', here 'AVX2'; ...", where `here`
// is `ours`. Empty if they are equal.
std::string differences(const std::string& theirs, const std::string& ours);

}  // namespace mandelmarch
