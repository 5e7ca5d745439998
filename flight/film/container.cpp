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

#include "core/os/input_file.h"
#include "core/os/output_file.h"
#include "core/text/error.h"

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

constexpr std::size_t box_head = 8;      // bytes: size and type
constexpr std::size_t number_size = 4;   // bytes of a number in a box
constexpr std::size_t entries_head = 8;  // bytes before the entries of the box stsd: version, flags, number of entries
constexpr std::size_t video_entry = 78;  // bytes of a codec's entry between its head and the boxes in it
constexpr char left_and_right = 2;       // st3d's value for side by side
constexpr std::string_view version_0{"\0\0\0\0", 4};

std::uint64_t big_endian(std::string_view bytes)
{
    std::uint64_t number = 0;
    for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
    return number;
}

std::string four_bytes(std::uint64_t number)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift);
    return bytes;
}

std::string box_of(std::string_view type, std::string_view content)
{
    return four_bytes(box_head + content.size()).append(type).append(content);
}

// Returns the boxes st3d and sv3d that describe the tags. The boxes say that the picture's centre has yaw, pitch and
// roll 0 and that the picture is not cropped.
std::string boxes_of(const Tags& tags)
{
    std::string boxes;
    if (tags.side_by_side) boxes += box_of("st3d", std::string(version_0) + left_and_right);
    if (tags.equirectangular) {
        const std::string made_by = box_of("svhd", std::string(version_0).append("mandelmarch").append(1, '\0'));
        const std::string pose = box_of("prhd", std::string(version_0.size() + 3 * number_size, '\0'));
        const std::string edges = box_of("equi", std::string(version_0.size() + 4 * number_size, '\0'));
        boxes += box_of("sv3d", made_by + box_of("proj", pose + edges));
    }
    return boxes;
}

std::size_t size_at(std::string_view data, std::size_t at) { return big_endian(data.substr(at, 4)); }

// Returns the offset of the first box of a type in [begin, end) of the data, or `end` if there is none. An empty type
// stands for any type.
std::size_t box_in(std::string_view data, std::size_t begin, std::size_t end, std::string_view type)
{
    for (std::size_t at = begin; at + box_head <= end;) {
        const std::size_t size = size_at(data, at);
        if (size < box_head || size > end - at) return end;
        if (type.empty() || data.substr(at + 4, 4) == type) return at;
        at += size;
    }
    return end;
}

// Returns the offsets of the boxes that contain the first codec's entry, from `moov` on, and of the entry itself, which
// is avc1 or vp09. Returns nothing if one of them is missing.
std::vector<std::size_t> path_to_entry(std::string_view data)
{
    std::vector<std::size_t> path;
    std::size_t begin = 0;
    std::size_t end = data.size();
    for (const std::string_view type : {"moov", "trak", "mdia", "minf", "stbl", "stsd", ""}) {
        const std::size_t at = box_in(data, begin, end, type);
        if (at == end) return {};
        path.push_back(at);
        begin = at + box_head + (type == "stsd" ? entries_head : 0);
        end = at + size_at(data, at);
    }
    return path;
}

// Returns true if the file is a sequence of complete boxes and one of them is `moov`, which ffmpeg writes last.
// ffmpeg's exit code does not suffice: if the disk becomes full while ffmpeg 5.1 writes `moov`, ffmpeg leaves an
// unreadable file and returns 0. A box begins with four bytes of size and four of name; a size of 1 means that the size
// is in the next eight bytes (ISO/IEC 14496-12, section 4.2).
bool whole_mp4(const std::string& file)
{
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) return false;
    bool movie = false;
    std::uint64_t at = 0;
    while (at < size) {
        std::array<char, 16> head{};
        stream.seekg(static_cast<std::streamoff>(at));
        if (!stream.read(head.data(), 8)) return false;
        std::uint64_t box = big_endian({head.data(), 4});
        if (box == 1) {
            if (!stream.read(head.data() + 8, 8)) return false;
            box = big_endian({head.data() + 8, 8});
        }
        // Size 0 means "to the end of the file". ffmpeg gives this size to the box of frames until the box is complete.
        if (box < 8 || box > size - at) return false;
        movie = movie || std::string_view(head.data() + 4, 4) == "moov";
        at += box;
    }
    return movie;
}

// Returns the size that a Matroska file must have according to its segment element; 0 if the segment element does not
// give a size, as in an unfinished file.
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

void tag_mp4(const std::string& from, const std::string& to, const Tags& tags)
{
    std::string data;
    InputFile(from, "MP4 file", NamedBy::program).append(data, SIZE_MAX);
    const std::string boxes = boxes_of(tags);
    const std::vector<std::size_t> around = path_to_entry(data);
    if (around.empty() || around.front() + size_at(data, around.front()) != data.size())
        throw Error(fmt::format("{}: not an MP4 file whose last box is the movie box", from));
    const std::size_t end = around.back() + size_at(data, around.back());
    for (const std::size_t at : around) data.replace(at, 4, four_bytes(size_at(data, at) + boxes.size()));
    data.insert(end, boxes);
    write_file(to, data, NamedBy::program);
}

void hide_vexu(const std::string& film)
{
    std::fstream stream(film, std::ios::in | std::ios::out | std::ios::binary);
    std::string data(box_head, '\0');
    std::uint64_t movie = 0;
    while (stream.read(data.data(), box_head) && data.substr(4) != "moov") {
        movie += std::max(size_at(data, 0), box_head);
        stream.seekg(static_cast<std::streamoff>(movie));
    }
    data.resize(size_at(data, 0));
    stream.seekg(static_cast<std::streamoff>(movie));
    stream.read(data.data(), static_cast<std::streamsize>(data.size()));
    const std::vector<std::size_t> path = path_to_entry(data);
    if (!stream || path.empty()) throw Error(film + ": not an MP4 file that begins with the movie box");
    const std::size_t end = path.back() + size_at(data, path.back());
    const std::size_t vexu = box_in(data, path.back() + box_head + video_entry, end, "vexu");
    if (vexu == end) return;
    stream.seekp(static_cast<std::streamoff>(movie + vexu + 4));
    if (!stream.write("free", 4).flush()) throw Error(film + ": cannot be written");
}

}  // namespace mandelmarch
