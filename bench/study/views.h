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

// The studies' own parameters of a fractal. Fractals without an entry in views.cpp have the defaults.
struct FractalStudy {
    static constexpr std::array usual_iterations{2, 4, 8, 16, 32, 64, 100};

    std::string_view fractal = "";                       // name
    std::span<const int> iterations = usual_iterations;  // numbers of iterations that a study compares
    // A view that is filled by the surface, for the study box-vs-bulb.
    struct CloseUp {
        Vector eye, target, up;
    };
    std::optional<CloseUp> close_up{};
    // Another scene of that study: the official one, with `added` added to its shape.
    struct Variant {
        std::string_view name;
        std::array<double, 3> added;
    };
    std::optional<Variant> variant{};
};

const FractalStudy& study_of(const Fractal& fractal);

// Returns the fractals that bench measures by default: those with an entry, or all if this build has none of them.
std::vector<const Fractal*> default_fractals();

// A scene of the study box-vs-bulb. All fractals have views of the same names, "official" among them.
struct View {
    std::string_view name;
    Scene scene;
};

// Returns the views of a fractal, at a size in pixels.
std::vector<View> views_of(std::string_view short_name, int width, int height);

}  // namespace mandelmarch::bench
