// SPDX-License-Identifier: Apache-2.0
// Whether a file is a whole MP4.
#pragma once

#include <string>

namespace mandelmarch {

// True where boxes (ISO/IEC 14496-12, section 4.2: a size of four bytes, a name of four, where the size is 1 eight
// bytes of size) fill the file to its end and one of them is `moov`, which ffmpeg writes last. ffmpeg 5.1 ends with
// exit code 0 when the disk is full just then, and leaves a file that no program can read.
bool whole_mp4(const std::string& file);

}  // namespace mandelmarch
