// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/resolution_control.h"

#include <algorithm>
#include <cmath>

namespace mandelmarch::explore {
namespace {

constexpr int parts = 24;         // sizes are multiples of 1/24 of the full width and height
constexpr int least_parts = 2;    // smallest size
constexpr int first_parts = 6;    // size of the first picture
constexpr double fixed = 0.0003;  // seconds; overhead per picture for threads and communication

}  // namespace

void ResolutionControl::took(double pixels, double seconds)
{
    costs_.at(known_++ % costs_.size()) = std::max(seconds - fixed, 1e-9) / std::max(pixels, 1.0);
}

double ResolutionControl::expected(double pixels) const
{
    const std::size_t count = std::min(known_, costs_.size());
    if (count == 0) return 0;
    return fixed + pixels * *std::max_element(costs_.begin(), costs_.begin() + static_cast<std::ptrdiff_t>(count));
}

std::pair<int, int> ResolutionControl::size(int width, int height, double seconds) const
{
    const auto of = [](int side, int part) { return std::max(1, side * part / parts); };
    int part = first_parts;
    if (known_ > 0) {
        part = parts;
        while (part > least_parts && expected(static_cast<double>(of(width, part)) * of(height, part)) > seconds)
            --part;
    }
    return {of(width, part), of(height, part)};
}

}  // namespace mandelmarch::explore
