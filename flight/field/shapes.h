// SPDX-License-Identifier: Apache-2.0
// The distance fields of a fractal one of whose shape parameters changes in flight, such as the Mandelbulb's power.
#pragma once

#include <optional>
#include <span>

#include "flight/field/field.h"

namespace mandelmarch {

class Shapes {
public:
    // `number`: index of the shape parameter that changes, in Scene::shape. The scene's own value is the usual one.
    Shapes(const Scene& scene, std::size_t number, int threads, const Budget* budget = nullptr);

    // The field at the usual value.
    const DistanceField& field() const { return field_; }
    double usual() const { return field_.scene().shape[number_]; }
    std::size_t number() const { return number_; }
    int threads() const { return field_.threads(); }
    const Budget* budget() const { return field_.budget(); }

    Scene scene(double value) const;
    // Returns the field at a value. It is built in `room` if the value is not the usual one.
    const DistanceField& at(double value, std::optional<DistanceField>& room) const;
    Bounds bounds(double value) const;

    // Writes the estimate at each point, for the shape at that point's value.
    void distances(std::span<const Vector> points, std::span<const double> values, std::span<double> out) const;

private:
    DistanceField field_;
    std::size_t number_;
};

}  // namespace mandelmarch
