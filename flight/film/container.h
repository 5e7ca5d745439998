// SPDX-License-Identifier: Apache-2.0
// The kinds of film files. A name's ending decides which one a film is.
#pragma once

#include <string>
#include <vector>

namespace mandelmarch {

// MP4 and Matroska hold H.264, WebM holds VP9. A GIF has a palette of 256 colours for each frame.
enum class Container { mp4, mkv, webm, gif };

// By the ending, whatever its case: .mp4, .m4v, .mkv, .webm or .gif; MP4 for a pipe or a device without one. Throws
// InputError.
Container container_of(const std::string& film);

// Throws InputError where such a film cannot have so many frames a second: a GIF counts hundredths of a second, and
// players slow down frames of less than two.
void check_rate(Container container, const std::string& film, int rate);

// ffmpeg's encoder for the segments, with its options. Segments are MP4 files, whatever the film is.
std::vector<std::string> video_codec(Container container);

// ffmpeg's options that make the film of its joined segments.
std::vector<std::string> joining(Container container);

// True for a file that is as long as its structure says. It finds files that a full disk cut, not errors of an encoder.
bool is_whole(const std::string& file, Container container);

}  // namespace mandelmarch
