// SPDX-License-Identifier: Apache-2.0
// Version of the project and revision of the sources that a program was built from.
#pragma once

#include <string>
#include <string_view>

namespace mandelmarch {

std::string_view project_version();  // "0.1.0"
std::string_view source_revision();  // full hash of git; "unknown" outside a repository
bool sources_changed();              // true if tracked files outside results/ differ from the revision

// Returns the output of --version: "NAME 0.1.0 (REVISION)", or "(REVISION, changed)".
std::string version_line(std::string_view program);

}  // namespace mandelmarch
