// SPDX-License-Identifier: Apache-2.0
// Distance estimators of the reference backend.
#pragma once

#include "core/render/backend.h"
#include "core/scene/scene.h"

namespace mandelmarch::reference {

// Estimators of the Mandelbox and the Mandelbulb. operator() returns the estimate at a point, and adds one DE
// evaluation (a call of the distance estimator) and its iterations to `work`.
class Mandelbox {
public:
    explicit Mandelbox(const Scene& scene);
    double operator()(Vector p, Work& work) const;

private:
    int iterations_;
    double scale_, inner2_, fixed2_, escape2_, remainder_;
};

class Mandelbulb {
public:
    explicit Mandelbulb(const Scene& scene);
    double operator()(Vector p, Work& work) const;

private:
    double stretch(Vector z, double r) const;

    int iterations_;
    double bailout_, power_;
    double envelope_;  // constant c of the conservative estimate's envelope; 0: original estimate
};

}  // namespace mandelmarch::reference
