// SPDX-License-Identifier: Apache-2.0
// Netpbm pictures: a header as text, then the rows from the top down. Writes P6 with 8 bits per channel. Reads P2 and
// P3 (pixels as text), P5 and P6 (pixels as bytes), in grey and colour, with any max value.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/image/formats/formats.h"
#include "core/image/formats/image_file.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

[[noreturn]] void refuse_pnm(const std::string& name, const std::string& why)
{
    throw InputError(fmt::format("{}: {}, expected a PNM picture (P2, P3, P5 or P6)", name, why));
}

class PnmReader {
public:
    PnmReader(std::span<const std::byte> data, const std::string& name) : data_(data), name_(name) {}

    Image read()
    {
        const char kind = data_.size() > 1 ? std::to_integer<char>(data_[1]) : '0';
        at_ = 2;
        const bool text = kind == '2' || kind == '3';
        const std::size_t channels = kind == '3' || kind == '6' ? 3 : 1;
        const std::uint32_t width = number();
        const std::uint32_t height = number();
        most_ = number();
        if (most_ < 1 || most_ > 0xffff) refuse_pnm(name_, fmt::format("its largest value is {}", most_));
        const std::size_t bytes = most_ < 256 ? 1 : 2;
        // If the pixels are bytes, one blank separates them from the header. If they are text, each value needs at
        // least a digit and a blank, but the last needs no blank.
        const std::size_t left = data_.size() - std::min(data_.size(), at_ + (text ? 0 : 1));
        check_claim(name_, {.width = width,
                            .height = height,
                            .pixel_bits = 8 * channels * (text ? 2 : bytes),
                            .most_bytes = left + (text ? 1 : 0),
                            .decoder = 0,
                            .layers = Image::Layers::bytes});
        // Programs for Windows write CR and LF before the pixels. LF may also be the first pixel: the size decides.
        const bool pair = left == bytes * channels * width * height + 1 && data_[at_] == std::byte{'\r'} &&
                          data_[at_ + 1] == std::byte{'\n'};
        if (!text) at_ += pair ? 2 : 1;
        Image image(static_cast<int>(width), static_cast<int>(height), Image::Layers::bytes);
        for (std::size_t y = height; y-- > 0;) {
            std::uint8_t* to = image.bytes().data() + 3 * y * width;
            for (std::size_t x = 0; x < width; ++x, to += 3) {
                for (std::size_t c = 0; c < channels; ++c) to[c] = byte(text ? number() : sample(bytes));
                if (channels == 1) to[1] = to[2] = to[0];
            }
        }
        while (text && at_ < data_.size() && is_blank()) ++at_;
        if (at_ < data_.size()) refuse_pnm(name_, "it does not end where its picture ends");
        return image;
    }

private:
    bool is_blank() const { return std::isspace(std::to_integer<unsigned char>(data_[at_])) != 0; }

    // Reads the next integer; skips blanks and comments before it.
    std::uint32_t number()
    {
        while (at_ < data_.size() && (is_blank() || data_[at_] == std::byte{'#'})) {
            if (data_[at_] == std::byte{'#'}) {
                while (at_ < data_.size() && data_[at_] != std::byte{'\n'} && data_[at_] != std::byte{'\r'}) ++at_;
            } else {
                ++at_;
            }
        }
        if (at_ == data_.size()) refuse_pnm(name_, "the file ends early");
        std::uint32_t value = 0;
        const std::size_t begin = at_;
        for (; at_ < data_.size() && at_ - begin < 9; ++at_) {
            const auto digit = std::to_integer<unsigned char>(data_[at_]);
            if (digit < '0' || digit > '9') break;
            value = 10 * value + digit - '0';
        }
        if (at_ == begin || (at_ < data_.size() && !is_blank() && data_[at_] != std::byte{'#'})) {
            refuse_pnm(name_, fmt::format("there is no number at byte {}", begin));
        }
        return value;
    }

    std::uint32_t sample(std::size_t bytes)
    {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < bytes; ++i) value = value << 8 | std::to_integer<std::uint32_t>(data_[at_++]);
        return value;
    }

    std::uint8_t byte(std::uint32_t value) const
    {
        if (value > most_) refuse_pnm(name_, fmt::format("a sample is {} and the largest value {}", value, most_));
        return static_cast<std::uint8_t>((255 * value + most_ / 2) / most_);
    }

    std::span<const std::byte> data_;
    const std::string& name_;
    std::size_t at_ = 0;
    std::uint32_t most_ = 255;
};

}  // namespace

void write_pnm(OutputFile& file, const Image& image)
{
    const std::string header = fmt::format("P6\n{} {}\n255\n", image.width(), image.height());
    file.write(header.data(), header.size());
    const std::size_t row = 3 * static_cast<std::size_t>(image.width());
    for (auto y = static_cast<std::size_t>(image.height()); y-- > 0;) {
        file.write(image.bytes().data() + y * row, row);
    }
}

Image decode_pnm(std::span<const std::byte> data, const std::string& name) { return PnmReader(data, name).read(); }

}  // namespace mandelmarch
