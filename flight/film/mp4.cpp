// SPDX-License-Identifier: Apache-2.0
#include "flight/film/mp4.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace mandelmarch {
namespace {

std::uint64_t big_endian(const unsigned char* bytes, int count)
{
    std::uint64_t number = 0;
    for (int i = 0; i < count; ++i) number = number << 8 | bytes[i];
    return number;
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
        unsigned char head[16];
        stream.seekg(static_cast<std::streamoff>(at));
        if (!stream.read(reinterpret_cast<char*>(head), 8)) return false;
        std::uint64_t box = big_endian(head, 4);
        if (box == 1) {
            if (!stream.read(reinterpret_cast<char*>(head + 8), 8)) return false;
            box = big_endian(head + 8, 8);
        }
        // Size 0 means "to the end of the file". ffmpeg gives this size to the box of frames until the box is complete.
        if (box < 8 || box > size - at) return false;
        movie = movie || std::memcmp(head + 4, "moov", 4) == 0;
        at += box;
    }
    return movie;
}

}  // namespace mandelmarch
