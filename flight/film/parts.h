// SPDX-License-Identifier: Apache-2.0
// The folder for a film's segments.
#pragma once

#include <string>

namespace mandelmarch {

// Returns FILM.parts, next to the file that `film` names or links to. For a stream, returns a folder in TMPDIR (or
// /tmp), named after the user and `made_of`, the digest of the film's description. Throws InputError if TMPDIR is not a
// folder.
std::string parts_folder(const std::string& film, const std::string& made_of);

// Creates that folder for a stream, accessible to this user only. Throws Error if it belongs to another user.
void make_private_folder(const std::string& folder);

}  // namespace mandelmarch
