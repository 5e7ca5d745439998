// SPDX-License-Identifier: Apache-2.0
#include "flight/film/title.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "core/base/output_file.h"
#include "flight/film/lettering.h"

namespace mandelmarch {
namespace {

// Returns the text with a backslash before each character that is one of `characters`.
std::string escaped(const std::string& text, std::string_view characters)
{
    std::string made;
    for (const char c : text) {
        if (characters.find(c) != std::string_view::npos) made += '\\';
        made += c;
    }
    return made;
}

constexpr double brightening = 0.5;  // seconds at the end of the title
// The fraction of the width that a line may take, in a perspective picture and in a picture of all directions.
constexpr double share_of_width = 0.92;
constexpr double share_of_circle = 0.25;
constexpr double title_height = 0.4;  // as fractions of a picture's height, for all lines of the text together
constexpr double authors_height = 0.3;

// One line of the title. Lengths are in pixels. The text is not escaped, because ffmpeg reads it from a file.
struct TitleLine {
    std::string text;
    int size;
    int below_middle;
};

std::vector<TitleLine> title_lines(const Title& title, const Picture& picture)
{
    const bool circle = picture.projection == Projection::equirectangular;
    const double width = picture.width / (picture.stereo ? 2.0 : 1.0) * (circle ? share_of_circle : share_of_width);
    const int height = picture.height;
    std::vector<TitleLine> all;
    if (title.empty()) return all;
    const Font font(title_font());
    // Adds the lines of a text. Line number `fixed` is placed `below_middle` pixels below the picture's middle, the
    // other lines above and below that one.
    const auto add = [&](const Lettering& letters, int below_middle, std::size_t fixed) {
        for (std::size_t i = 0; i < letters.lines.size(); ++i) {
            const double lines = static_cast<double>(i) - static_cast<double>(fixed);
            const auto offset = static_cast<int>(std::lround(lines * line_height * letters.size));
            if (!letters.lines[i].empty()) all.push_back({letters.lines[i], letters.size, below_middle + offset});
        }
    };
    if (!title.title.empty()) {
        const auto letters = lettering(font, "--title", title.title, height / 11, width, title_height * height);
        add(letters, -height / 24, letters.lines.size() - 1);
    }
    if (!title.authors.empty()) {
        add(lettering(font, "--authors", title.authors, height / 28, width, authors_height * height), height / 12, 0);
    }
    return all;
}

// Returns the ffmpeg filter that draws a line. `centre`: the line's centre in pixels from the left.
std::string line_filter(const std::string& file, const TitleLine& line, int centre)
{
    return fmt::format(
        "drawtext={}:textfile={}:expansion=none:fontcolor=white:fontsize={}:x={}-text_w/2:y=(h-text_h)/"
        "2+{}:alpha='min(1,t/0.8)*min(1,max(0,(3.9-t)/0.6))'",
        font_option(), file, line.size, centre, line.below_middle);
}

}  // namespace

std::string title_font()
{
    const char* named = std::getenv("MANDELMARCH_FONT");
    if (named == nullptr || *named == '\0') return "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    return std::filesystem::absolute(named).string();
}

std::string font_option()
{
    // The path is escaped twice: as a filter's option, and again as part of a filter graph (manual of ffmpeg-filters,
    // "Notes on filtergraph escaping").
    return "fontfile=" + escaped(escaped(title_font(), "\\':\t\n "), "\\'[],;\t\n ");
}

void check_title(const Title& title, const Picture& picture) { static_cast<void>(title_lines(title, picture)); }

void write_title(const std::string& folder, const std::string& file, const std::vector<std::uint8_t>& first,
                 const Picture& picture, const Title& title, const Coding& coding)
{
    std::string filter;
    const std::vector<TitleLine> lines = title_lines(title, picture);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string text = fmt::format("title-{}.txt", i);
        write_file(folder + "/" + text, lines[i].text);
        const int eyes = picture.stereo ? 2 : 1;
        for (int eye = 0; eye < eyes; ++eye) {
            if (!filter.empty()) filter += ',';
            filter += line_filter(text, lines[i], (2 * eye + 1) * picture.width / (2 * eyes));
        }
    }
    Encoder encoder(folder, file, picture.width, picture.height, filter, coding);
    const auto frames = static_cast<int>(title_frames(coding.frames_per_second));
    const int bright = std::max(1, static_cast<int>(std::lround(brightening * coding.frames_per_second)));
    for (int i = 0; i < frames; ++i) {
        // The frame has a third of its brightness. During the last half second it brightens to its full brightness.
        const int light = bright + 2 * std::max(0, i - (frames - bright));
        std::vector<std::uint8_t> frame = first;
        for (auto& c : frame) c = static_cast<std::uint8_t>(c * light / (3 * bright));
        encoder.add(std::move(frame));
    }
    encoder.finish();
}

}  // namespace mandelmarch
