// SPDX-License-Identifier: Apache-2.0
#include "flight/film/container.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "flight/film/mp4.h"

namespace mandelmarch {
namespace {

struct FilmEnding {
    std::string_view ending;
    Container container;
};
constexpr std::array film_endings{FilmEnding{".mp4", Container::mp4}, FilmEnding{".m4v", Container::mp4},
                                  FilmEnding{".mkv", Container::mkv}, FilmEnding{".webm", Container::webm},
                                  FilmEnding{".gif", Container::gif}};
constexpr int fastest_gif = 50;  // frames per second

// Returns the size that a Matroska file must have according to its segment element; 0 if that does not give a size, as
// in an unfinished file.
std::uint64_t segment_end(std::ifstream& stream)
{
    std::array<unsigned char, 64> head{};
    stream.read(reinterpret_cast<char*>(head.data()), head.size());
    constexpr std::array<unsigned char, 4> segment{0x18, 0x53, 0x80, 0x67};
    const auto* const at = std::search(head.begin(), head.end(), segment.begin(), segment.end());
    if (head.end() - at < 12 || at[4] != 0x01) return 0;  // 0x01: a size of seven bytes follows
    std::uint64_t size = 0;
    for (int i = 5; i < 12; ++i) size = size << 8 | at[i];
    return static_cast<std::uint64_t>(at - head.begin()) + 12 + size;
}

bool is_whole_gif(std::ifstream& stream)
{
    std::array<char, 4> first{};
    char last = 0;
    stream.read(first.data(), first.size());
    stream.seekg(-1, std::ios::end);
    stream.get(last);
    constexpr char trailer = 0x3b;
    return stream && std::string_view(first.data(), first.size()) == "GIF8" && last == trailer;
}

}  // namespace

Container container_of(const std::string& film)
{
    std::string ending = std::filesystem::path(film).extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    const auto* const found = std::ranges::find(film_endings, ending, &FilmEnding::ending);
    if (found != film_endings.end()) return found->container;
    if (OutputFile::is_stream(film)) return Container::mp4;
    throw InputError(
        fmt::format("{}: the file name's ending names no kind of film, expected .mp4, .mkv, .webm or .gif", film));
}

void check_rate(Container container, const std::string& film, int rate)
{
    if (container != Container::gif || rate <= fastest_gif) return;
    throw InputError(fmt::format("{}: a GIF of {} frames a second, expected at most {}, or .mp4, .mkv or .webm", film,
                                 rate, fastest_gif));
}

std::vector<std::string> video_codec(Container container)
{
    // sync-lookahead=0 turns off x264's lookahead thread. With that thread, the end of a clip is sometimes encoded
    // differently if the machine is busy.
    if (container != Container::webm)
        return {"-c:v", "libx264", "-preset", "veryfast", "-crf", "18", "-x264-params", "sync-lookahead=0"};
    return {"-c:v", "libvpx-vp9", "-deadline", "good", "-cpu-used", "4", "-crf", "24", "-b:v", "0", "-row-mt", "1"};
}

std::vector<std::string> joining(Container container)
{
    switch (container) {
        case Container::mkv: return {"-c", "copy", "-f", "matroska"};
        case Container::webm: return {"-c", "copy", "-f", "webm"};
        case Container::gif:
            // One palette per frame: computing a common palette would keep all frames in memory.
            return {"-vf", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1", "-f", "gif"};
        default: return {"-c", "copy", "-movflags", "+faststart", "-f", "mp4"};
    }
}

bool is_whole(const std::string& file, Container container)
{
    if (container == Container::mp4) return whole_mp4(file);
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) return false;
    return container == Container::gif ? is_whole_gif(stream) : size > 0 && segment_end(stream) == size;
}

}  // namespace mandelmarch
