// SPDX-License-Identifier: Apache-2.0
// The kinds of film files. The ending of a film's name decides its kind.
#pragma once

#include <string>
#include <vector>

namespace mandelmarch {

// MP4 and Matroska hold H.264, WebM holds VP9. A GIF has a palette of 256 colours for each frame.
enum class Container { mp4, mkv, webm, gif };

// The container by the name's ending, in upper or lower case: .mp4, .m4v, .mkv, .webm or .gif; MP4 for a pipe or device
// without an ending. Throws InputError for other names.
Container container_of(const std::string& film);

// Throws InputError if the container does not allow `rate` frames a second. A GIF counts hundredths of a second, and
// players slow down frames shorter than two of them.
void check_rate(Container container, const std::string& film, int rate);

// ffmpeg's encoder for the segments, with its options. Segments are MP4 files, whatever the film is.
std::vector<std::string> video_codec(Container container);

// ffmpeg's options for joining the segments to the film.
std::vector<std::string> joining(Container container);

// True if the file is as long as its structure demands. This finds files that a full disk cut, not an encoder's errors.
bool is_whole(const std::string& file, Container container);

}  // namespace mandelmarch
