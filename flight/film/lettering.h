// SPDX-License-Identifier: Apache-2.0
// Fonts, and the largest size at which a text fits.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mandelmarch {

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

// Lays out the text in letters of the wanted size, or smaller ones if it would not fit into `width` x `height`; all in
// pixels. A long line is broken in two if that makes the letters larger. Throws InputError if the letters would be
// illegible, or as Font::check() does. The message begins with `option`.
Lettering lettering(const Font& font, const std::string& option, const std::string& text, int wanted, double width,
                    double height);

}  // namespace mandelmarch
