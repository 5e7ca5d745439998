// SPDX-License-Identifier: Apache-2.0
// The formats of film files. A film's format follows from the extension of its file name.
#pragma once

#include <string>
#include <vector>

namespace mandelmarch {

// MP4 and Matroska contain H.264, WebM contains VP9. A GIF has a palette of 256 colours for each frame.
enum class Container { mp4, mkv, webm, gif };

// Returns the container for the extension of a film's name: .mp4, .m4v, .mkv, .webm or .gif, in upper or lower case. A
// pipe or device without one of these extensions gets MP4. Throws InputError for all other names.
Container container_of(const std::string& film);

// Throws InputError if the container does not allow `rate` frames per second. A GIF's unit of time is 0.01 s, and
// players slow down frames shorter than 0.02 s.
void check_rate(Container container, const std::string& film, int rate);

// Returns ffmpeg's options for encoding segments. Segments are MP4 files for every container.
std::vector<std::string> video_codec(Container container);

// Returns ffmpeg's options for joining the segments to the film.
std::vector<std::string> joining(Container container);

// Returns true if the file has the length that its structure requires. This detects files truncated by a full disk, but
// does not detect encoding errors.
bool is_whole(const std::string& file, Container container);

// The properties of a film's pictures that a player needs in order to show them.
struct Tags {
    bool equirectangular = false;  // a picture shows all directions
    bool side_by_side = false;     // stereo; the left eye's picture is on the left

    bool none() const { return !equirectangular && !side_by_side; }
};

// Copies the MP4 file `from` to `to` and adds the boxes st3d and sv3d to its video track, as defined by Google's
// "Spherical Video V2 RFC" (https://github.com/google/spatial-media/blob/master/docs/spherical-video-v2-rfc.md). ffmpeg
// 5.1 keeps these boxes when it copies a file, but does not have an option that sets them. The movie box (moov), which
// grows, must be the last box of the file, where ffmpeg writes it. Otherwise the pictures behind it would move, and
// their stored offsets would be wrong. Throws Error if `from` is not an MP4 file that ends with the movie box.
void tag_mp4(const std::string& from, const std::string& to, const Tags& tags);

// Replaces the box vexu of an MP4 film that begins with its movie box, if it has one, by an unused box. ffmpeg 7.1
// writes it for stereo films. It does not say that the pictures are side by side, and ffmpeg's readers then ignore the
// box st3d, which does.
void hide_vexu(const std::string& film);

}  // namespace mandelmarch
