// SPDX-License-Identifier: Apache-2.0
// Where a film's segments gather.
#pragma once

#include <string>

namespace mandelmarch {

// FILM.parts beside the file that the name means, also through links. Of a stream, which has no place beside it, a
// folder of this user's in TMPDIR (or /tmp), named by the digest of what the film is made of. Throws InputError where
// TMPDIR is no folder.
std::string parts_folder(const std::string& film, const std::string& made_of);

// Makes that folder for a stream, for this user alone. Throws Error where it is somebody else's.
void make_private_folder(const std::string& folder);

}  // namespace mandelmarch
