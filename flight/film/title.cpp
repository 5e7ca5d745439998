#include "flight/film/title.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/output_file.h"
#include "flight/film/encoder.h"

namespace mandelmarch {
namespace {

constexpr int brightening = 15;  // frames

// The text stands in a file, so that it needs no escapes.
std::string line_filter(const std::string& file, int size, int below_middle)
{
    return fmt::format(
        "drawtext=fontfile={}:textfile={}:expansion=none:fontcolor=white:fontsize={}:x=(w-text_w)/2:y=(h-text_h)/"
        "2+{}:alpha='min(1,t/"
        "0.8)*min(1,max(0,(3.9-t)/0.6))'",
        title_font(), file, size, below_middle);
}

void write_text(const std::string& path, const std::string& text)
{
    OutputFile file(path);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace

std::string title_font()
{
    const char* named = std::getenv("MANDELMARCH_FONT");
    return named != nullptr && *named != '\0' ? named : "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
}

void write_title(const std::string& folder, const std::string& file, const std::vector<std::uint8_t>& first, int width,
                 int height, const std::string& title, const std::string& authors)
{
    std::string filter;
    if (!title.empty()) {
        write_text(folder + "/title.txt", title);
        filter = line_filter("title.txt", height / 11, -height / 24);
    }
    if (!authors.empty()) {
        write_text(folder + "/authors.txt", authors);
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
