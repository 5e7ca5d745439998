// SPDX-License-Identifier: Apache-2.0
#include "core/text/text.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/text/error.h"

namespace mandelmarch {
namespace {

// Returns the length in bytes of the UTF-8 character at the beginning of `text`; 0 if the text begins with no such
// character, or with a control character from U+0080 to U+009F.
std::size_t utf8_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t length = byte(0) < 0x80   ? 1
                               : byte(0) < 0xc2 ? 0
                               : byte(0) < 0xe0 ? 2
                               : byte(0) < 0xf0 ? 3
                               : byte(0) < 0xf5 ? 4
                                                : 0;
    if (length > text.size()) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
    }
    return length == 2 && byte(0) == 0xc2 && byte(1) < 0xa0 ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text, std::size_t most)
{
    std::string made;
    while (!text.empty()) {
        if (made.size() >= most) return made + "...";
        const unsigned char c = static_cast<unsigned char>(text.front());
        std::size_t length = utf8_length(text);
        if (c == '\n') {
            made += "\\n";
        } else if (c == '\t') {
            made += "\\t";
        } else if (c == '\r') {
            made += "\\r";
        } else if (c < 0x20 || c == 0x7f || length == 0) {
            made += fmt::format("\\x{:02x}", c);
            length = 1;
        } else {
            made += text.substr(0, length);
        }
        text.remove_prefix(length);
    }
    return made;
}

std::string_view trimmed(std::string_view text)
{
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator)
{
    std::vector<std::string_view> parts;
    for (std::size_t from = 0; from <= text.size(); from += parts.back().size() + 1) {
        parts.push_back(text.substr(from, text.find(separator, from) - from));
    }
    return parts;
}

void check_json_depth(std::string_view text, const std::string& name)
{
    std::size_t depth = 0;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted) {
            if (c == '\\') ++i;
            quoted = c != '"';
        } else if (c == '"') {
            quoted = true;
        } else if (c == '[' || c == '{') {
            if (++depth > deepest_json) {
                throw InputError(fmt::format("{}: brackets are nested more than {} deep", name, deepest_json));
            }
        } else if ((c == ']' || c == '}') && depth > 0) {
            --depth;
        }
    }
}

}  // namespace mandelmarch
