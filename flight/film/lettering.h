// SPDX-License-Identifier: Apache-2.0
// The letters of a font, and the largest size at which a text fits.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mandelmarch {

class Font {
public:
    // Throws Error unless the file is a font with scalable letters.
    explicit Font(const std::string& file);
    ~Font();
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    // Throws InputError, which begins with `option`, if the text is not UTF-8 or has letters that the font lacks.
    void check(const std::string& option, std::string_view text) const;

    // The width of one line, in units of the letters' size.
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

// Sets the text at the wanted size in pixels, or as large as width and height (pixels) allow; a long line is broken in
// two if that makes the letters larger. Throws InputError, which begins with `option`, if the letters were too small to
// read, or the font lacks some.
Lettering lettering(const Font& font, const std::string& option, const std::string& text, int wanted, double width,
                    double height);

}  // namespace mandelmarch
