// SPDX-License-Identifier: Apache-2.0
#include "flight/film/mp4.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/base/output_file.h"

namespace mandelmarch {
namespace {

constexpr std::size_t box_head = 8;      // bytes: size and type
constexpr std::size_t entries_head = 8;  // bytes before the entries of the box stsd: version, flags, number of entries
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

// Returns the boxes st3d and sv3d that describe the tags. They say that the picture's centre has yaw, pitch and roll 0
// and that the picture is not cropped.
std::string boxes_of(const Tags& tags)
{
    std::string boxes;
    if (tags.side_by_side) boxes += box_of("st3d", std::string(version_0) + left_and_right);
    if (tags.equirectangular) {
        const std::string made_by = box_of("svhd", std::string(version_0).append("mandelmarch").append(1, '\0'));
        const std::string pose = box_of("prhd", std::string(version_0.size() + 3 * 4, '\0'));
        const std::string edges = box_of("equi", std::string(version_0.size() + 4 * 4, '\0'));
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

}  // namespace

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

void tag_mp4(const std::string& from, const std::string& to, const Tags& tags)
{
    std::ostringstream text;
    const std::ifstream stream(from, std::ios::binary);
    if (!stream || !(text << stream.rdbuf())) throw Error(from + ": cannot be read");
    std::string data = text.str();
    const std::string boxes = boxes_of(tags);
    std::vector<std::size_t> around;  // offsets of the boxes that contain the new ones
    std::size_t begin = 0;
    std::size_t end = data.size();
    // The empty type at the end finds the codec's entry, which is avc1 or vp09.
    for (const std::string_view type : {"moov", "trak", "mdia", "minf", "stbl", "stsd", ""}) {
        const std::size_t at = box_in(data, begin, end, type);
        const bool last = around.empty() && at < end && at + size_at(data, at) != data.size();
        if (at == end || last) throw Error(fmt::format("{}: not an MP4 file whose last box is the movie box", from));
        around.push_back(at);
        begin = at + box_head + (type == "stsd" ? entries_head : 0);
        end = at + size_at(data, at);
    }
    for (const std::size_t at : around) data.replace(at, 4, four_bytes(size_at(data, at) + boxes.size()));
    data.insert(end, boxes);
    write_file(to, data);
}

}  // namespace mandelmarch
