// SPDX-License-Identifier: Apache-2.0
// Letters of a font: which it has, and how large a text fits.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace mandelmarch {

class Font {
public:
    // Throws Error where the file is no font whose letters have any size.
    explicit Font(const std::string& file);
    ~Font();
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    // Throws InputError, which begins with `option`, where a text is no UTF-8 or has letters that the font lacks.
    void check(const std::string& option, std::string_view text) const;

    // Of one line, in sizes of a letter.
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

inline constexpr double line_height = 1.3;  // sizes of a letter

// The text at the wanted size in pixels, or as large as width and height (pixels) allow, where a long line is broken in
// two if that makes it larger. Throws InputError, which begins with `option`, where the letters would be too small to
// read, or the font lacks some.
Lettering lettering(const Font& font, const std::string& option, const std::string& text, int wanted, double width,
                    double height);

}  // namespace mandelmarch
