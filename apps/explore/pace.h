// SPDX-License-Identifier: Apache-2.0
// How large a picture may be that is there in time.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

namespace mandelmarch::explore {

class Pace {
public:
    // A picture of so many pixels took so long.
    void took(double pixels, double seconds);
    // What took() was told is of something else.
    void forget() { known_ = 0; }

    // The largest size of this shape, at most width x height, that takes `seconds` or less: a whole number of
    // twenty-fourths of each side. At first a quarter of each.
    std::pair<int, int> size(int width, int height, double seconds) const;

    // Seconds that a picture of so many pixels takes; 0: not known.
    double expected(double pixels) const;

private:
    // The dearest of the last pictures counts: views change faster than averages.
    std::array<double, 6> costs_{};  // seconds a pixel
    std::size_t known_ = 0;
};

}  // namespace mandelmarch::explore
