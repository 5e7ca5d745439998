// SPDX-License-Identifier: Apache-2.0
// Checks MP4 files for completeness.
#pragma once

#include <string>

namespace mandelmarch {

// True if boxes (ISO/IEC 14496-12, section 4.2: four bytes of size, four of name, eight more of size if the size is 1)
// fill the file to its end and one of them is `moov`, which ffmpeg writes last. If the disk becomes full while it
// writes `moov`, ffmpeg 5.1 leaves an unreadable file and returns exit code 0.
bool whole_mp4(const std::string& file);

}  // namespace mandelmarch
