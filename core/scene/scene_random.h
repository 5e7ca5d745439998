// SPDX-License-Identifier: Apache-2.0
// Random numbers for scenes, the same on every machine.
#pragma once

#include <cmath>
#include <random>

#include "core/scene/vector.h"

namespace mandelmarch {

class SceneRandom {
public:
    explicit SceneRandom(std::mt19937& random) : random_(random) {}

    double between(double low, double high)
    {
        return low + (high - low) * static_cast<double>(random_()) / 4294967295.0;
    }

    // Returns a number whose logarithm is uniformly distributed. low and high must be positive.
    double magnitude(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }

    // Rounds to single precision, as the parser of parameter files does.
    static double single(double value) { return double{static_cast<float>(value)}; }
    double single_between(double low, double high) { return single(between(low, high)); }

    bool one_in(int count) { return random_() % static_cast<unsigned>(count) == 0; }

    double sign() { return one_in(2) ? -1 : 1; }

    Vector direction()
    {
        for (;;) {
            const double x = between(-1, 1);
            const double y = between(-1, 1);
            const Vector v{x, y, between(-1, 1)};
            if (length(v) > 0.1 && length(v) < 1) return unit(v);
        }
    }

private:
    std::mt19937& random_;
};

}  // namespace mandelmarch
