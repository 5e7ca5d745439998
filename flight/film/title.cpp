// SPDX-License-Identifier: Apache-2.0
#include "flight/film/title.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "core/base/output_file.h"
#include "flight/film/encoder.h"

namespace mandelmarch {
namespace {

// A backslash before each of these characters.
std::string escaped(const std::string& text, std::string_view characters)
{
    std::string made;
    for (const char c : text) {
        if (characters.find(c) != std::string_view::npos) made += '\\';
        made += c;
    }
    return made;
}

constexpr int brightening = 15;  // frames

// The text stands in a file, so that it needs no escapes.
std::string line_filter(const std::string& file, int size, int below_middle)
{
    return fmt::format(
        "drawtext={}:textfile={}:expansion=none:fontcolor=white:fontsize={}:x=(w-text_w)/2:y=(h-text_h)/"
        "2+{}:alpha='min(1,t/"
        "0.8)*min(1,max(0,(3.9-t)/0.6))'",
        font_option(), file, size, below_middle);
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
    // Read twice (ffmpeg-filters, "Notes on filtergraph escaping"): as one of a filter's options, in a graph of
    // filters.
    return "fontfile=" + escaped(escaped(title_font(), "\\':\t\n "), "\\'[],;\t\n ");
}

void write_title(const std::string& folder, const std::string& file, const std::vector<std::uint8_t>& first, int width,
                 int height, const std::string& title, const std::string& authors)
{
    std::string filter;
    if (!title.empty()) {
        write_file(folder + "/title.txt", title);
        filter = line_filter("title.txt", height / 11, -height / 24);
    }
    if (!authors.empty()) {
        write_file(folder + "/authors.txt", authors);
        if (!filter.empty()) filter += ',';
        filter += line_filter("authors.txt", height / 28, height / 12);
    }
    Encoder encoder(folder, file, width, height, filter);
    for (int i = 0; i < title_frames; ++i) {
        // In the last half second the picture brightens to the first frame of the flight: from a third to all its
        // light.
        const int light = brightening + 2 * std::max(0, i - (title_frames - brightening));
        std::vector<std::uint8_t> frame = first;
        for (auto& c : frame) c = static_cast<std::uint8_t>(c * light / (3 * brightening));
        encoder.add(std::move(frame));
    }
    encoder.finish();
}

}  // namespace mandelmarch
