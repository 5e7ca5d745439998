// SPDX-License-Identifier: Apache-2.0
// The title: a few seconds before the flight, over its first frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mandelmarch {

inline constexpr int title_frames = 120;  // 4 s

// A font file of Debian's fonts-dejavu-core, or what MANDELMARCH_FONT names.
std::string title_font();

// The same as an option of ffmpeg's drawtext, whatever characters its path has.
std::string font_option();

// Writes the title as a segment: `first` (RGB, from the top row) darkened, with both lines of text. The texts may hold
// any characters; an empty line is left out. Throws Error where the encoder fails.
void write_title(const std::string& folder, const std::string& file, const std::vector<std::uint8_t>& first, int width,
                 int height, const std::string& title, const std::string& authors);

}  // namespace mandelmarch
