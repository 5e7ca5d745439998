// SPDX-License-Identifier: Apache-2.0
// The output of --stats: configuration, times and work counts as JSON.
#pragma once

#include <string>
#include <vector>

#include "apps/survey.h"
#include "core/render/backend.h"

namespace mandelmarch {

// Writes the JSON to the file `path`. Times are in seconds. Throws Error if the file cannot be written.
void write_stats(const std::string& path, const Scene& scene, const RenderStats& report, const Survey& survey,
                 const std::vector<std::string>& warnings);

}  // namespace mandelmarch
