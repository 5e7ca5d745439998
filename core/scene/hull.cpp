// SPDX-License-Identifier: Apache-2.0
#include "core/scene/hull.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/scene/scene.h"

namespace mandelmarch {

bool Bounds::contains(Vector p) const
{
    if (shape == Shape::sphere) return length(p) <= size;
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= size;
}

// Uses t <= r + |eye|, which holds for every point of a ray at distance r from the origin.
double radius_where(const std::function<double(double)>& bound, double radius, const ViewLimits& view)
{
    const auto free = [&](double r) { return bound(r) > view.slope * (r + view.distance); };
    double low = radius;
    double high = 100 * radius;
    if (!free(high)) return 0;
    while (high - low > 1e-4 * radius) {
        const double middle = 0.5 * (low + high);
        (free(middle) ? high : low) = middle;
    }
    return high;
}

double least_estimate(double start, double power, double stretch, double added, double one, double escape,
                      int iterations)
{
    double r = start;
    double dr = 1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= iterations; ++i) {
        if (!(r > 1)) return 0;
        least = std::min(least, 0.5 * r * std::log(r) / dr);
        if (r > escape) return least;
        dr = stretch * power * std::pow(r, power - 1) * dr + one;
        r = std::pow(r, power) - added;
    }
    return 0;
}

double hull_size(const Scene& scene, double tolerance)
{
    // At a hit, DE < tolerance t. The original stepping uses the t after the step that follows the sample; this step is
    // at most twice the estimate.
    if (tolerance > 0.1) return 0;
    const ViewLimits view{1.02 * tolerance / (1 - 2 * tolerance), length(scene.eye)};
    const double size = scene.fractal->hull.size(scene, view);
    // The margin allows for rounding errors: positions in float are off by a few ulp of the eye's distance.
    return size > 0 ? size * (1 + 1e-4) + 1e-5 * view.distance : 0;
}

}  // namespace mandelmarch
