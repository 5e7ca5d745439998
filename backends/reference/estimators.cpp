// SPDX-License-Identifier: Apache-2.0
#include "backends/reference/estimators.h"

#include <algorithm>
#include <cmath>

namespace mandelmarch::reference {
namespace {

double fold(double c) { return std::abs(c) > 1 ? std::copysign(2, c) - c : c; }

}  // namespace

Mandelbox::Mandelbox(const Scene& scene)
    : iterations_(scene.iterations),
      scale_(scene.shape[0]),
      inner2_(scene.shape[1] * scene.shape[1]),
      fixed2_(scene.shape[2] * scene.shape[2]),
      escape2_(scene.escape * scene.escape),
      remainder_(std::pow(std::abs(scene.shape[0]), 1 - scene.iterations))
{
}

double Mandelbox::operator()(Vector p, Work& work) const
{
    Vector z = p;
    double k = 1;
    double r2 = -1;  // squared radius of the folded point; below 0 at first, so that the loop runs
    int i = 0;
    for (; i < iterations_ && r2 < escape2_; ++i) {
        z = {fold(z.x), fold(z.y), fold(z.z)};
        r2 = dot(z, z);
        double factor = 1;
        if (r2 < inner2_) {
            factor = fixed2_ / inner2_;
        } else if (r2 < fixed2_) {
            factor = fixed2_ / r2;
        }
        z = scale_ * (factor * z) + p;
        k = k * factor * std::abs(scale_) + 1;
    }
    ++work.de_calls;
    work.iterations += static_cast<std::uint64_t>(i);
    return (length(z) - std::abs(scale_ - 1)) / k - remainder_;
}

Mandelbulb::Mandelbulb(const Scene& scene)
    : iterations_(scene.iterations),
      bailout_(scene.shape[1]),
      power_(scene.shape[2]),
      envelope_(scene.conservative ? 0.7 : 0)
{
}

// Returns the factor by which z -> z^P stretches lengths along a circle of latitude more than lengths along the radius.
// The factor is approximate and at least 1; for the original estimate it is 1.
double Mandelbulb::stretch(Vector z, double r) const
{
    if (!(envelope_ > 0)) return 1;
    return std::max(1.0, envelope_ * std::min(power_, r / std::hypot(z.x, z.y)));
}

double Mandelbulb::operator()(Vector p, Work& work) const
{
    Vector z = p;
    double dr = 1;
    double r = 0;
    int i = 0;
    for (; i < iterations_; ++i) {
        r = length(z);
        if (r > bailout_) break;
        const double polar = power_ * std::acos(z.z / r);
        const double azimuth = power_ * std::atan2(z.y, z.x);
        dr = power_ * std::pow(r, power_ - 1) * stretch(z, r) * dr + 1;
        z = std::pow(r, power_) *
                Vector{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)} +
            p;
    }
    ++work.de_calls;
    work.iterations += static_cast<std::uint64_t>(i);
    return 0.5 * std::log(r) * r / dr;
}

}  // namespace mandelmarch::reference
