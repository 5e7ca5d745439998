// SPDX-License-Identifier: Apache-2.0
#include "flight/film/title.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>

#include "core/os/output_file.h"
#include "core/text/environment.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr int least_letter = 8;          // pixels; smallest legible size, but a smaller wanted size is allowed
constexpr double rather_broken = 0.6;    // fraction of the wanted size below which a line is broken in two
constexpr int tab_blanks = 4;            // blanks in place of a tab, as in ffmpeg's drawtext
constexpr std::size_t most_lacking = 8;  // largest number of letters that a message lists
constexpr std::string_view line_ends = "\n\r\f\v";

// Removes the first letter from a UTF-8 text and returns that letter; nullopt if the bytes are invalid.
std::optional<char32_t> take_letter(std::string_view& text)
{
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t length = first < 0x80 ? 1 : first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (length == 0 || first > 0xf4 || length > text.size()) return std::nullopt;
    char32_t letter = length == 1 ? first : first & (0x7fU >> length);
    for (const char c : text.substr(1, length - 1)) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0) != 0x80) return std::nullopt;
        letter = letter << 6 | (byte & 0x3f);
    }
    text.remove_prefix(length);
    return letter;
}

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find_first_of(line_ends, begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        begin = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    }
    return lines;
}

// Returns the largest size of letters, in pixels, at which the lines fit; at most the wanted size.
int fitting(const Font& font, const std::vector<std::string>& lines, int wanted, double width, double height)
{
    double widest = 0;
    for (const std::string& line : lines) widest = std::max(widest, font.width(line));
    const double high = line_height * static_cast<double>(lines.size());
    return static_cast<int>(std::min({static_cast<double>(wanted), width / std::max(widest, 1e-3), height / high}));
}

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

constexpr double brightening = 0.5;  // seconds at the end of the title in which the picture brightens
// The fraction of the width that a line may take, in a perspective picture and in a picture of all directions.
constexpr double share_of_width = 0.92;
constexpr double share_of_circle = 0.25;
constexpr double title_height = 0.4;  // fraction of the picture's height; for all lines of the title together
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
    // other lines above and below it.
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

struct Font::Face {
    FT_Library library = nullptr;
    FT_Face face = nullptr;

    Face() = default;
    Face(const Face&) = delete;
    Face& operator=(const Face&) = delete;
    ~Face()
    {
        if (face != nullptr) FT_Done_Face(face);
        if (library != nullptr) FT_Done_FreeType(library);
    }
};

Font::Font(const std::string& file) : face_(std::make_unique<Face>()), file_(file)
{
    const bool read =
        FT_Init_FreeType(&face_->library) == 0 && FT_New_Face(face_->library, file.c_str(), 0, &face_->face) == 0;
    if (!read || !FT_IS_SCALABLE(face_->face)) {
        throw Error(fmt::format("{}: not a font file with scalable letters", file));
    }
}

Font::~Font() = default;

void Font::check(const std::string& option, std::string_view text) const
{
    std::vector<std::string> lacking;
    while (!text.empty()) {
        const std::string_view before = text;
        const auto letter = take_letter(text);
        if (!letter) throw InputError(fmt::format("{}: the text is not valid UTF-8", option));
        const std::string_view bytes = before.substr(0, before.size() - text.size());
        if (*letter == '\t' || line_ends.find(bytes) != std::string_view::npos) continue;
        if (FT_Get_Char_Index(face_->face, *letter) != 0) continue;
        const auto code = static_cast<std::uint32_t>(*letter);
        std::string name = *letter < ' ' ? fmt::format("U+{:04X}", code) : fmt::format("{} (U+{:04X})", bytes, code);
        if (std::ranges::find(lacking, name) == lacking.end()) lacking.push_back(std::move(name));
    }
    if (lacking.empty()) return;
    const std::size_t named = std::min(lacking.size(), most_lacking);
    const std::span first(lacking.data(), named);
    throw InputError(
        fmt::format("{}: the font {} lacks {}{}, expected letters that it has, or another font in "
                    "MANDELMARCH_FONT",
                    option, file_, fmt::join(first, ", "),
                    named < lacking.size() ? fmt::format(" and {} more", lacking.size() - named) : ""));
}

double Font::width(std::string_view line) const
{
    FT_Pos units = 0;
    FT_UInt before = 0;
    while (!line.empty()) {
        const auto letter = take_letter(line);
        if (!letter) break;
        const FT_UInt index = FT_Get_Char_Index(face_->face, *letter == '\t' ? ' ' : *letter);
        if (FT_Load_Glyph(face_->face, index, FT_LOAD_NO_SCALE) != 0) continue;
        FT_Vector kerning{};
        FT_Get_Kerning(face_->face, before, index, FT_KERNING_UNSCALED, &kerning);
        units += kerning.x + face_->face->glyph->metrics.horiAdvance * (*letter == '\t' ? tab_blanks : 1);
        before = index;
    }
    return static_cast<double>(units) / face_->face->units_per_EM;
}

Lettering lettering(const Font& font, const std::string& option, const std::string& text, int wanted, double width,
                    double height)
{
    font.check(option, text);
    Lettering best{lines_of(text), 0};
    best.size = fitting(font, best.lines, wanted, width, height);
    if (best.lines.size() == 1 && best.size < rather_broken * wanted) {
        const std::string& line = text;
        for (std::size_t at = line.find(' '); at != std::string::npos; at = line.find(' ', at + 1)) {
            Lettering broken{{line.substr(0, at), line.substr(at + 1)}, 0};
            broken.size = fitting(font, broken.lines, wanted, width, height);
            if (broken.size > best.size) best = std::move(broken);
        }
    }
    if (best.size < std::min(least_letter, wanted)) {
        throw InputError(fmt::format("{}: a text of {} bytes needs letters of {} pixels to fit, expected a shorter one",
                                     option, text.size(), best.size));
    }
    return best;
}

std::string title_font()
{
    const std::string named = environment_variable("MANDELMARCH_FONT");
    if (named.empty()) return "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    std::error_code none;
    if (std::filesystem::is_regular_file(named, none)) return std::filesystem::absolute(named).string();
    throw InputError(fmt::format("MANDELMARCH_FONT: {} is not a file, expected a font file", named));
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
        write_file(fmt::format("{}/{}", folder, text), lines[i].text, NamedBy::program);
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
        // The first frame of the flight is shown at a third of its brightness. In the last half second it becomes as
        // bright as in the flight.
        const int light = bright + 2 * std::max(0, i - (frames - bright));
        std::vector<std::uint8_t> frame = first;
        for (auto& c : frame) c = static_cast<std::uint8_t>(c * light / (3 * bright));
        encoder.add(std::move(frame));
    }
    encoder.finish();
}

}  // namespace mandelmarch
