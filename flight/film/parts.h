// SPDX-License-Identifier: Apache-2.0
// The folder for a film's segments.
#pragma once

#include <string>

namespace mandelmarch {

// Returns the path FILM.parts, where FILM is the file that `film` names or links to. If `film` is a pipe or device,
// returns a path in TMPDIR (or /tmp) that contains the user's number and `made_of`, the digest of the film's
// description. Throws InputError if TMPDIR is not a folder.
std::string parts_folder(const std::string& film, const std::string& made_of);

// Creates a folder that only this user can access. An existing folder is used if it belongs to this user and other
// users cannot write to it; otherwise throws Error.
void make_private_folder(const std::string& folder);

}  // namespace mandelmarch
