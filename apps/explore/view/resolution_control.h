// SPDX-License-Identifier: Apache-2.0
// Resolution control: finds the size of the largest picture that can be rendered in a given time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/text/quantile.h"

namespace mandelmarch::explore {

class ResolutionControl {
public:
    // Records the render time of a picture.
    void took(double pixels, double seconds)
    {
        costs_.at(known_++ % costs_.size()) = std::max(seconds - fixed, 1e-9) / std::max(pixels, 1.0);
    }

    // Discards all recorded times.
    void forget() { known_ = 0; }

    // Returns the largest size whose picture is expected to take at most `seconds`. Both sides are the same fraction of
    // `width` and `height`, a multiple of 1/24. Fractions below a quarter, whose pictures show little, are chosen only
    // if a picture would else take more than a tenth of a second. If no times have been recorded, the fraction is a
    // quarter.
    std::pair<int, int> size(int width, int height, double seconds) const
    {
        const auto of = [](int side, int part) { return std::max(1, side * part / parts); };
        int part = known_ > 0 ? parts : usual_parts;
        const auto exceeds = [&](double limit) {
            return expected(static_cast<double>(of(width, part)) * of(height, part)) > limit;
        };
        while (part > usual_parts && exceeds(seconds)) --part;
        while (part > least_parts && exceeds(std::max(seconds, slow))) --part;
        return {of(width, part), of(height, part)};
    }

    // Returns the expected render time of a picture in seconds; 0 if no times have been recorded.
    double expected(double pixels) const
    {
        const std::size_t count = std::min(known_, costs_.size());
        if (count == 0) return 0;
        return fixed +
               pixels * upper_median(std::vector(costs_.begin(), costs_.begin() + static_cast<std::ptrdiff_t>(count)));
    }

private:
    static constexpr int parts = 24;         // sizes are multiples of 1/24 of the full width and height
    static constexpr int least_parts = 2;    // smallest size, in 24ths
    static constexpr int usual_parts = 6;    // size of the first picture, in 24ths
    static constexpr double slow = 0.1;      // seconds; longest picture for the sake of its size
    static constexpr double fixed = 0.0003;  // seconds; overhead per picture for threads and communication

    // Costs of the last pictures in seconds per pixel. expected() uses their median, so that a picture during which
    // other programs had the cores does not count.
    std::array<double, 6> costs_{};
    std::size_t known_ = 0;
};

}  // namespace mandelmarch::explore
