// SPDX-License-Identifier: Apache-2.0
// MP4 files: a check for completeness, and the tags by which players recognise 360-degree and stereo films.
#pragma once

#include <string>

namespace mandelmarch {

// Returns true if the file is a sequence of complete boxes and one of them is `moov`, which ffmpeg writes last. The
// exit code alone is not enough: if the disk becomes full while ffmpeg 5.1 writes `moov`, it leaves an unreadable file
// and returns 0. A box begins with four bytes of size and four of name; a size of 1 means that the size is in the next
// eight bytes (ISO/IEC 14496-12, section 4.2).
bool whole_mp4(const std::string& file);

// The properties of a film's pictures that a player must know to show them.
struct Tags {
    bool equirectangular = false;  // a picture shows all directions
    bool side_by_side = false;     // stereo; the left eye's picture is on the left

    bool none() const { return !equirectangular && !side_by_side; }
};

// Copies the MP4 file `from` to `to` and adds the boxes st3d and sv3d to its video track, as defined by Google's
// "Spherical Video V2 RFC" (https://github.com/google/spatial-media/blob/master/docs/spherical-video-v2-rfc.md). ffmpeg
// 5.1 keeps these boxes when it copies a file, but does not have an option that sets them. The movie box (moov) must be
// the last box of the file, so that the offsets of the pictures do not change; ffmpeg writes it there. Throws Error if
// `from` is not such a file.
void tag_mp4(const std::string& from, const std::string& to, const Tags& tags);

}  // namespace mandelmarch
