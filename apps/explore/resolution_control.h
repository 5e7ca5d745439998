// SPDX-License-Identifier: Apache-2.0
// Resolution control: the largest picture that can be rendered in a given time.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace mandelmarch::explore {

class ResolutionControl {
public:
    // Records the render time of a picture.
    void took(double pixels, double seconds);
    // Discards all recorded times.
    void forget() { known_ = 0; }

    // Returns the largest size that takes `seconds` or less: a multiple of 1/24 of width and height, at least 2/24.
    // Without recorded times, a quarter of each.
    std::pair<int, int> size(int width, int height, double seconds) const;

    // Returns the expected seconds for a picture; 0: unknown.
    double expected(double pixels) const;

private:
    // Costs of the last pictures, seconds per pixel. The largest one counts, as views change too fast for an average.
    std::array<double, 6> costs_{};
    std::size_t known_ = 0;
};

}  // namespace mandelmarch::explore
