// SPDX-License-Identifier: Apache-2.0
// MP4 tags by which players recognise 360-degree and stereo films.
#pragma once

#include <string>

namespace mandelmarch {

// The properties of a film's pictures that a player needs.
struct Tags {
    bool equirectangular = false;  // all directions
    bool side_by_side = false;     // stereo, the left eye's picture on the left

    bool none() const { return !equirectangular && !side_by_side; }
};

// Copies the MP4 file `from` to `to` and tags its video track with the boxes st3d and sv3d of Google's "Spherical Video
// V2 RFC" (https://github.com/google/spatial-media/blob/master/docs/spherical-video-v2-rfc.md). The movie box must be
// the last box, as ffmpeg writes it, so that the pictures' file offsets do not change. ffmpeg 5.1 keeps such boxes when
// it copies a file, but has no option that sets them. Throws Error if `from` is not such a file.
void tag_mp4(const std::string& from, const std::string& to, const Tags& tags);

}  // namespace mandelmarch
