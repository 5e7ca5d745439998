// SPDX-License-Identifier: Apache-2.0
// A fractal one of whose numbers changes in flight, the Mandelbulb's power, say: its distances at each value.
#pragma once

#include <optional>
#include <span>

#include "flight/field/field.h"

namespace mandelmarch {

class Shapes {
public:
    // `number`: which of the scene's three shape numbers changes. The scene's own value is the usual one.
    Shapes(const Scene& scene, std::size_t number, int threads, const Budget* budget = nullptr);

    // At the usual value.
    const Field& field() const { return field_; }
    double usual() const { return field_.scene().shape[number_]; }
    std::size_t number() const { return number_; }
    int threads() const { return field_.threads(); }
    const Budget* budget() const { return field_.budget(); }

    Scene scene(double value) const;
    // The field at a value; `room` holds it where the value is not the usual one.
    const Field& at(double value, std::optional<Field>& room) const;
    Hull hull(double value) const;

    // The estimate at each point, of the shape at the point's own value.
    void distances(std::span<const Vector> points, std::span<const double> values, std::span<double> out) const;

private:
    Field field_;
    std::size_t number_;
};

}  // namespace mandelmarch
