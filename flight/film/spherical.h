// SPDX-License-Identifier: Apache-2.0
// Tags that make players recognize films of all directions, or for two eyes.
#pragma once

#include <string>

namespace mandelmarch {

// The properties of a film's pictures that a player has to know.
struct Tags {
    bool equirectangular = false;  // all directions
    bool side_by_side = false;     // two eyes, the left one's picture on the left

    bool none() const { return !equirectangular && !side_by_side; }
};

// Copies the MP4 file `from` to `to` and tags its video track by the boxes st3d and sv3d of Google's "Spherical Video
// V2 RFC" (https://github.com/google/spatial-media/blob/master/docs/spherical-video-v2-rfc.md). The movie box must come
// after the pictures, as ffmpeg places it, so that no picture moves. ffmpeg 5.1 keeps such boxes when it copies a file,
// but has no option that sets them. Throws Error if `from` is no such file.
void tag_mp4(const std::string& from, const std::string& to, const Tags& tags);

}  // namespace mandelmarch
