// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/panorama.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr double coarse_share = 0.02;  // hit tolerance, as a fraction of the ray's length so far
constexpr int most_steps = 60;         // a ray with more steps counts as a hit

}  // namespace

Sphere::Sphere(int count, double window)
{
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count;
        const double r = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
        directions_.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    near_.resize(directions_.size());
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        near_[i].push_back(static_cast<int>(i));
        for (std::size_t j = 0; j < directions_.size(); ++j) {
            if (i != j && dot(directions_[i], directions_[j]) > std::cos(window))
                near_[i].push_back(static_cast<int>(j));
        }
    }
}

int Sphere::nearest(Vector unit_vector) const
{
    const auto closer = [&](Vector a, Vector b) { return dot(a, unit_vector) < dot(b, unit_vector); };
    return static_cast<int>(std::ranges::max_element(directions_, closer) - directions_.begin());
}

std::vector<float> panoramas(const Shapes& shapes, const Sphere& sphere, std::span<const Vector> places,
                             std::span<const double> values, double end)
{
    const std::size_t count = sphere.directions().size();
    std::vector<float> depths(places.size() * count);
    parallel(places.size(), 8, shapes.threads(), [&](std::size_t first, std::size_t last) {
        std::vector<Vector> from(count);
        std::vector<double> t(count);
        for (std::size_t i = first; i < last; ++i) {
            std::ranges::fill(from, places[i]);
            std::optional<DistanceField> room;
            shapes.at(values[i], room)
                .casts(from, sphere.directions(),
                       {.floor = 0, .tolerance = coarse_share, .end = end, .steps = most_steps}, t);
            std::ranges::transform(t, depths.begin() + static_cast<std::ptrdiff_t>(i * count), [end](double depth) {
                return depth < end ? static_cast<float>(depth) : std::numeric_limits<float>::infinity();
            });
        }
    });
    return depths;
}

}  // namespace mandelmarch
