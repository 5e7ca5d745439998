// SPDX-License-Identifier: Apache-2.0
// The title: text over the flight's first frame, shown for a few seconds before the flight.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
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
// installed by Debian's package fonts-dejavu-core. Throws InputError if the variable does not name a file.
std::string title_font();

// Returns the font as an option of ffmpeg's drawtext, with special characters of its path escaped.
std::string font_option();

class Font {
public:
    // Throws Error if the file is not a font with scalable letters.
    explicit Font(const std::string& file);
    ~Font();
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    // Throws InputError if the text is not UTF-8 or has letters that the font lacks. The message begins with `option`.
    void check(const std::string& option, std::string_view text) const;

    // Returns the width of one line, in units of the letters' size.
    double width(std::string_view line) const;

private:
    struct Face;
    std::unique_ptr<Face> face_;
    std::string file_;
};

struct Lettering {
    std::vector<std::string> lines;
    int size = 0;  // pixels
};

inline constexpr double line_height = 1.3;  // in units of the letters' size

// Lays out the text in letters of the size `wanted`, or in smaller letters if it would not fit into `width` x `height`
// otherwise. These three arguments are in pixels. A long line is broken in two if that makes the letters larger. Throws
// InputError if the letters would be illegible, or as Font::check() does. The message begins with `option`.
Lettering lettering(const Font& font, const std::string& option, const std::string& text, int wanted, double width,
                    double height);

struct Title {
    std::string title;    // large, in the middle; may have several lines
    std::string authors;  // smaller, below

    bool empty() const { return title.empty() && authors.empty(); }
};

// Throws InputError if a text does not fit into the picture even in the smallest letters, or if it has letters that the
// font lacks. Throws Error if the font cannot be read.
void check_title(const Title& title, const Picture& picture);

// Writes the title as a video file of title_seconds. The video shows both texts over the darkened picture `first` (RGB,
// top row first). In stereo, each text appears once for each eye. A text that is too long gets smaller letters; an
// empty text is left out. Throws as check_title() does, and Error if the encoder fails.
void write_title(const std::string& folder, const std::string& file, const std::vector<std::uint8_t>& first,
                 const Picture& picture, const Title& title, const Coding& coding);

}  // namespace mandelmarch
