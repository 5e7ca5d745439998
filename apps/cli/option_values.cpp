// SPDX-License-Identifier: Apache-2.0
#include "apps/cli/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/text/error.h"
#include "core/text/number.h"
#include "core/scene/scene.h"

namespace mandelmarch {
namespace {

struct NamedSize {
    std::string_view name;
    int width, height;  // pixels
};
constexpr std::array named_sizes{NamedSize{"720p", 1280, 720}, NamedSize{"1080p", 1920, 1080},
                                 NamedSize{"4k", 3840, 2160}, NamedSize{"8k", 7680, 4320}};

[[noreturn]] void refuse(const std::string& name, const std::string& text, const std::string& expected)
{
    throw InputError(fmt::format("--{}: '{}' given, expected {}", name, text, expected));
}

}  // namespace

CLI::Validator whole(std::int64_t low, std::int64_t high)
{
    return {[=](const std::string& text) {
                const auto value = parse_whole(text);
                if (value && *value >= low && *value <= high) return std::string();
                return fmt::format("'{}' given, expected a whole number from {} to {}", text, low, high);
            },
            ""};
}

CLI::Validator real(double low, double high)
{
    return {[=](const std::string& text) {
                const auto value = parse_real(text);
                if (value && *value >= low && *value <= high) return std::string();
                return fmt::format("'{}' given, expected a number from {} to {}", text, low, high);
            },
            ""};
}

int whole_option(const std::string& name, const std::string& text, int low, int high)
{
    const auto value = parse_whole(text);
    if (!value || *value < low || *value > high) {
        refuse(name, text, fmt::format("a whole number from {} to {}", low, high));
    }
    return static_cast<int>(*value);
}

std::pair<int, int> pair_option(const std::string& name, const std::string& text, char between, int low, int high,
                                const std::string& expected)
{
    const auto at = text.find(between);
    const auto first = parse_whole(text.substr(0, at));
    const auto second = parse_whole(at == std::string::npos ? "" : text.substr(at + 1));
    if (!first || !second || std::min(*first, *second) < low || std::max(*first, *second) > high) {
        refuse(name, text, expected);
    }
    return {static_cast<int>(*first), static_cast<int>(*second)};
}

std::string input_name(const std::string& name) { return name == "-" ? "/dev/stdin" : name; }

std::string output_name(const std::string& name) { return name == "-" ? "/dev/stdout" : name; }

std::pair<int, int> size_option(const std::string& text, int most_side, int panoramas)
{
    for (const NamedSize& known : named_sizes) {
        if (text != known.name) continue;
        if (panoramas > 0) return {panoramas * known.width, known.width / 2};
        return {known.width, known.height};
    }
    return pair_option("size", text, 'x', 1, most_side,
                       fmt::format("WIDTHxHEIGHT with sides from 1 to {}, 720p, 1080p, 4k or 8k", most_side));
}

Region region_option(const std::string& text, int width, int height)
{
    std::array<std::int64_t, 4> numbers{};
    std::size_t count = 0;
    for (std::size_t at = 0; at <= text.size() && count < numbers.size(); ++count) {
        const std::size_t end = std::min(text.find_first_of(count < 2 ? "," : ",x", at), text.size());
        numbers.at(count) = parse_whole(text.substr(at, end - at)).value_or(-1);
        at = end + 1;
        if (count == 3 && end != text.size()) numbers[0] = -1;
    }
    const auto [x, y, w, h] = numbers;
    const bool inside = count == 4 && x >= 0 && y >= 0 && w > 0 && h > 0 && x < width && y < height && w <= width - x &&
                        h <= height - y;
    if (!inside) {
        refuse("region", text,
               fmt::format("X,Y,WIDTH,HEIGHT of a part of {} x {} pixels, from the bottom left", width, height));
    }
    return {static_cast<int>(x), static_cast<int>(y), static_cast<int>(w), static_cast<int>(h)};
}

}  // namespace mandelmarch
