// SPDX-License-Identifier: Apache-2.0
// The summary of a rendered film as JSON.
#pragma once

#include <string>

#include "flight/film/film.h"

namespace mandelmarch {

// Returns JSON with device, size, mode, frames rendered in this run, seconds, and seconds per frame (null if none was
// rendered).
std::string summary_of(const Path& path, const Backend& backend, const FilmOptions& options, const FilmStats& report,
                       int processes);

}  // namespace mandelmarch
