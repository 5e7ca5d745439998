// SPDX-License-Identifier: Apache-2.0
// Scenes of the studies: the official ones and others.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/scene/fractal.h"
#include "core/scene/scene.h"

namespace mandelmarch::bench {

// Parameters of the studies for one fractal. Fractals without an entry in views.cpp have the defaults.
struct FractalStudy {
    static constexpr std::array usual_iterations{2, 4, 8, 16, 32, 64, 100};

    std::string_view fractal;                            // name
    std::span<const int> iterations = usual_iterations;  // limits that the study `iterations` compares
    // A view that the surface fills, for the study box-vs-bulb.
    struct CloseUp {
        Vector eye, target, up;
    };
    std::optional<CloseUp> close_up{};
    // Another scene of the study box-vs-bulb: the official scene, with `added` added to its shape.
    struct Variant {
        std::string_view name;
        std::array<double, 3> added;
    };
    std::optional<Variant> variant{};
};

const FractalStudy& study_of(const Fractal& fractal);

// Returns the fractals that bench measures by default: those with an entry in views.cpp, or all fractals if this build
// has none of them.
std::vector<const Fractal*> default_fractals();

// A scene of the study box-vs-bulb. Every fractal has the views "official", "near", "far" and "coarse". A fractal with
// a close-up also has the view "close". A fractal with a Variant also has a view with the Variant's name.
struct View {
    std::string_view name;
    Scene scene;
};

// Returns the views of a fractal, at a size in pixels.
std::vector<View> views_of(std::string_view short_name, int width, int height);

}  // namespace mandelmarch::bench
