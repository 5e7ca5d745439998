// SPDX-License-Identifier: Apache-2.0
// Checks MP4 files for completeness.
#pragma once

#include <string>

namespace mandelmarch {

// Returns true if the file is a sequence of complete boxes and one of them is `moov`, which ffmpeg writes last. The
// exit code alone is not enough: if the disk becomes full while ffmpeg 5.1 writes `moov`, it leaves an unreadable file
// and returns 0. A box begins with four bytes of size and four of name; a size of 1 means that the size is in the next
// eight bytes (ISO/IEC 14496-12, section 4.2).
bool whole_mp4(const std::string& file);

}  // namespace mandelmarch
