// SPDX-License-Identifier: Apache-2.0
// What making a film took: the figures that are reported of it.
#pragma once

#include <string>

#include "flight/film/film.h"

namespace mandelmarch {

// JSON with device, size, mode, frames rendered in this run, seconds, and seconds a frame (null where none was
// rendered).
std::string summary_of(const Path& path, const Backend& backend, const FilmOptions& options, const FilmReport& report,
                       int processes);

}  // namespace mandelmarch
