// SPDX-License-Identifier: Apache-2.0
#include "core/text/number.h"

#include <charconv>
#include <cmath>

namespace mandelmarch {
namespace {

template <class Number>
std::optional<Number> parse(std::string_view text)
{
    if (text.starts_with('+')) {
        text.remove_prefix(1);
        if (text.starts_with('-')) return std::nullopt;
    }
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

}  // namespace

std::optional<long long> parse_whole(std::string_view text) { return parse<long long>(text); }

std::optional<double> parse_real(std::string_view text)
{
    const auto value = parse<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

}  // namespace mandelmarch
