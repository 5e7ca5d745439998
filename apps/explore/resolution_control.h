// SPDX-License-Identifier: Apache-2.0
// Resolution control: finds the size of the largest picture that can be rendered in a given time.
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

    // Returns the largest size whose picture is expected to take at most `seconds`. It is `width` x `height` times a
    // multiple of 1/24, at least 2/24; a quarter of each side if no times have been recorded.
    std::pair<int, int> size(int width, int height, double seconds) const;

    // Returns the expected render time of a picture in seconds; 0 if no times have been recorded.
    double expected(double pixels) const;

private:
    // Costs of the last pictures in seconds per pixel. expected() uses the largest one, because views change too fast
    // for an average.
    std::array<double, 6> costs_{};
    std::size_t known_ = 0;
};

}  // namespace mandelmarch::explore
