// SPDX-License-Identifier: Apache-2.0
// The summary of a rendered film as JSON.
#pragma once

#include <string>

#include "flight/film/film.h"

namespace mandelmarch {

// Returns JSON with the device, the size, the mode and the frames of this run with their times. `processes`: number of
// ranks. The time per frame is null if this run did not render a frame.
std::string summary_of(const Path& path, const Backend& backend, const FilmOptions& options, const FilmStats& report,
                       int processes);

}  // namespace mandelmarch
