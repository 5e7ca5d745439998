// SPDX-License-Identifier: Apache-2.0
#include "core/scene/hull.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/scene/scene.h"

namespace mandelmarch {
namespace {

// The smallest radius at which `bound`, a lower bound of DE at that distance from the origin and beyond, exceeds what a
// hit could have there; 0 if there is none up to 100 times `radius`. A point at distance r is seen at t <= r + |eye|.
double radius_where(const std::function<double(double)>& bound, double radius, const Sight& view)
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

// The least 0.5 r ln r / dr along r -> r^P - added, dr -> P r^(P-1) dr + one, from r = start up to an escape; 0 without
// an escape in `iterations`.
double least_estimate(double start, double power, double added, double one, double escape, int iterations)
{
    double r = start;
    double dr = 1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= iterations; ++i) {
        if (!(r > 1)) return 0;
        least = std::min(least, 0.5 * r * std::log(r) / dr);
        if (r > escape) return least;
        dr = power * std::pow(r, power - 1) * dr + one;
        r = std::pow(r, power) - added;
    }
    return 0;
}

}  // namespace

double box_hull(const Scene& scene, const Sight& view)
{
    const auto [scale, inner, fixed] = scene.shape;
    const double s = std::abs(scale);
    if (s <= 1 || inner > fixed) return 0;
    // DE >= share (X - edge) - less at a point whose largest coordinate is X > edge.
    const double remainder = std::pow(s, 1 - scene.iterations);
    const double edge = scale > 0 ? 2 * (s + 1) / (s - 1) : 2;
    const double share = scale > 0 ? s * (s - 1) / (s * s + s + 1) : 1;
    const double less =
        scale > 0 ? std::max({0.0, (s - 3) / (s + 1), (s - 1 - edge) / (s * s + s + 1)}) : (s - 1) / (s + 1);
    const double slope = share - std::sqrt(3.0) * view.slope;
    if (!(slope > 0)) return 0;
    return (share * edge + less + remainder + view.slope * view.distance) / slope;
}

double bulb_hull(const Scene& scene, const Sight& view)
{
    const double escape = scene.shape[1];
    const double power = scene.shape[2];
    if (power <= 1) return 0;
    // The estimator leaves out the last radius, so that the escape must come before.
    const auto bound = [&](double r) { return least_estimate(r, power, r, 1, escape, scene.iterations - 1); };
    return radius_where(bound, std::pow(2, 1 / (power - 1)), view);
}

double julia_hull(const Scene& scene, const Sight& view)
{
    const auto [a, i, j] = scene.shape;
    const double c = std::sqrt(a * a + i * i + j * j + scene.escape * scene.escape);
    const double escape = std::sqrt(scene.fractal->constants(scene, 1e37, false).values[4]);
    const auto bound = [&](double r) { return least_estimate(r, 2, c, 0, escape, scene.iterations); };
    return radius_where(bound, 0.5 * (1 + std::sqrt(1 + 4 * c)), view);
}

double hull_size(const Scene& scene, double tolerance)
{
    // A hit is DE < tolerance t with the t after the step, which goes at most twice the estimate.
    if (tolerance > 0.1) return 0;
    const Sight view{1.02 * tolerance / (1 - 2 * tolerance), length(scene.eye)};
    const double size = scene.fractal->hull(scene, view);
    // Floats: positions are off by a few units in the last place of the eye's distance.
    return size > 0 ? size * (1 + 1e-4) + 1e-5 * view.distance : 0;
}

}  // namespace mandelmarch
