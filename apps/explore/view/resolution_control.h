// SPDX-License-Identifier: Apache-2.0
// Resolution control: finds the size of the largest picture that can be rendered in a given time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

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
    // `width` and `height`: a multiple of 1/24, at least 2/24. If no times have been recorded, the fraction is a
    // quarter.
    std::pair<int, int> size(int width, int height, double seconds) const
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

    // Returns the expected render time of a picture in seconds; 0 if no times have been recorded.
    double expected(double pixels) const
    {
        const std::size_t count = std::min(known_, costs_.size());
        if (count == 0) return 0;
        return fixed + pixels * *std::max_element(costs_.begin(), costs_.begin() + static_cast<std::ptrdiff_t>(count));
    }

private:
    static constexpr int parts = 24;         // sizes are multiples of 1/24 of the full width and height
    static constexpr int least_parts = 2;    // smallest size, in 24ths
    static constexpr int first_parts = 6;    // size of the first picture, in 24ths
    static constexpr double fixed = 0.0003;  // seconds; overhead per picture for threads and communication

    // Costs of the last pictures in seconds per pixel. expected() uses the largest one, because views change too fast
    // for an average.
    std::array<double, 6> costs_{};
    std::size_t known_ = 0;
};

}  // namespace mandelmarch::explore
