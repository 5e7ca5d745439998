// SPDX-License-Identifier: Apache-2.0
#include "flight/field/shapes.h"

#include <algorithm>

#include "flight/field/threads.h"

namespace mandelmarch {

Shapes::Shapes(const Scene& scene, std::size_t number, int threads, const Budget* budget)
    : field_(scene, threads, budget), number_(number)
{
}

Scene Shapes::scene(double value) const
{
    Scene scene = field_.scene();
    scene.shape[number_] = value;
    return scene;
}

const DistanceField& Shapes::at(double value, std::optional<DistanceField>& room) const
{
    if (value == usual()) return field_;
    return room.emplace(scene(value), field_.threads(), field_.budget());
}

void Shapes::distances(std::span<const Vector> points, std::span<const double> values, std::span<double> out) const
{
    if (std::ranges::all_of(values, [this](double value) { return value == usual(); })) {
        field_.distances(points, out);
        return;
    }
    parallel(points.size(), 64, field_.threads(), [&](std::size_t first, std::size_t last) {
        // Consecutive points with the same value share a field.
        for (std::size_t at = first, end = first; at < last; at = end) {
            while (end < last && values[end] == values[at]) ++end;
            std::optional<DistanceField> room;
            this->at(values[at], room).distances(points.subspan(at, end - at), out.subspan(at, end - at));
        }
    });
}

}  // namespace mandelmarch
