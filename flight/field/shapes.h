// SPDX-License-Identifier: Apache-2.0
// Distance fields of a fractal for flights during which one shape parameter changes, such as the Mandelbulb's power.
#pragma once

#include <optional>
#include <span>

#include "flight/field/field.h"

namespace mandelmarch {

class Shapes {
public:
    // `number`: index in Scene::shape of the parameter that changes. Its value in `scene` is called the usual value.
    Shapes(const Scene& scene, std::size_t number, int threads, const Budget* budget = nullptr);

    // Returns the distance field of the shape with the usual value.
    const DistanceField& field() const { return field_; }
    double usual() const { return field_.scene().shape[number_]; }
    int threads() const { return field_.threads(); }
    const Budget* budget() const { return field_.budget(); }

    Scene scene(double value) const;
    // Returns the distance field of the shape with this value. If the value is not the usual one, the field is built in
    // `room`, and the returned reference is valid until `room` changes or ends.
    const DistanceField& at(double value, std::optional<DistanceField>& room) const;

    // Writes the estimate at each point. `values`: for each point, the parameter's value.
    void distances(std::span<const Vector> points, std::span<const double> values, std::span<double> out) const;

private:
    DistanceField field_;
    std::size_t number_;
};

}  // namespace mandelmarch
