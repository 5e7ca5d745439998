// SPDX-License-Identifier: Apache-2.0
// The title: a few seconds before the flight, over its first frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "flight/film/encoder.h"
#include "flight/film/frames.h"

namespace mandelmarch {

inline constexpr int title_seconds = 4;
constexpr std::size_t title_frames(int rate)
{
    return static_cast<std::size_t>(title_seconds) * static_cast<std::size_t>(rate);
}

// Returns the path of the font file: the value of the environment variable MANDELMARCH_FONT, or DejaVu Sans as
// installed by Debian's package fonts-dejavu-core.
std::string title_font();

// Returns the font as an option of ffmpeg's drawtext, with special characters of its path escaped.
std::string font_option();

struct Title {
    std::string title;    // large, in the middle; may have several lines
    std::string authors;  // smaller, below

    bool empty() const { return title.empty() && authors.empty(); }
};

// Throws InputError if a text does not fit into the picture even in the smallest letters, or if it has letters that the
// font lacks. Throws Error if the font cannot be read.
void check_title(const Title& title, const Picture& picture);

// Writes the title as a video file of title_seconds. It shows the picture `first` (RGB, top row first) darkened, and
// over it both texts, in stereo once for each eye. A text that is too long gets smaller letters; an empty one is left
// out. Throws as check_title() does, and Error if the encoder fails.
void write_title(const std::string& folder, const std::string& file, const std::vector<std::uint8_t>& first,
                 const Picture& picture, const Title& title, const Coding& coding);

}  // namespace mandelmarch
