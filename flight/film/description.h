// SPDX-License-Identifier: Apache-2.0
// Descriptions of the inputs of a film or of stills, and summaries of films, as JSON. A finished file is reused only if
// its description is the same.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/render/backend.h"
#include "flight/film/film.h"
#include "flight/path/path.h"

namespace mandelmarch {

// Returns one line of JSON with everything that the pixels of a path's pictures depend on, followed by the names and
// values in `more`. The line includes the program's digest, because another build may render other bits.
std::string description_of(const Path& path, const Backend& backend, const Picture& picture,
                           const RendererOptions& renderer,
                           const std::vector<std::pair<std::string, std::string>>& more);

// Returns the differences between two descriptions as text for a message, for example "instructions: 'SCALAR', here
// 'AVX2'; ...". The value after "here" is that of `ours`. Empty if the descriptions are equal.
std::string differences(const std::string& theirs, const std::string& ours);

// Returns the summary of a rendered film: JSON with the device, the size, the mode, the number of frames rendered in
// this run, and the time. `processes`: number of ranks. The number of threads is 0 if the backend does not use it. The
// time per frame is null if this run did not render a frame.
std::string summary_of(const Path& path, const Backend& backend, const FilmOptions& options, const FilmStats& report,
                       int processes);

}  // namespace mandelmarch
