// SPDX-License-Identifier: Apache-2.0
// Which version of the project a program is, and of which revision of its sources it was built.
#pragma once

#include <string>
#include <string_view>

namespace mandelmarch {

std::string_view project_version();  // "0.1.0"
std::string_view source_revision();  // git's, whole; "unknown" outside a repository
bool sources_changed();              // tracked files outside report/results differed from the revision

// What --version prints: "NAME 0.1.0 (REVISION)", or "(REVISION, changed)".
std::string version_line(std::string_view program);

}  // namespace mandelmarch
