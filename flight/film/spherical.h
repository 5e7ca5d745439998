// SPDX-License-Identifier: Apache-2.0
// Tags by which players know films that show all directions, or two eyes.
#pragma once

#include <string>

namespace mandelmarch {

// What of a film's pictures a player has to know.
struct Tags {
    bool equirectangular = false;  // all directions
    bool side_by_side = false;     // two eyes, the left one's picture on the left

    bool none() const { return !equirectangular && !side_by_side; }
};

// The MP4 file `from` as `to`, its video track tagged by the boxes st3d and sv3d of Google's "Spherical Video V2 RFC"
// (https://github.com/google/spatial-media/blob/master/docs/spherical-video-v2-rfc.md). Its movie box has to stand
// behind the pictures, as ffmpeg leaves it, so that no picture moves. ffmpeg 5.1 writes such boxes where a file that it
// copies has them, and no option sets them. Throws Error where `from` is no such file.
void tag_mp4(const std::string& from, const std::string& to, const Tags& tags);

}  // namespace mandelmarch
