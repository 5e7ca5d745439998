// SPDX-License-Identifier: Apache-2.0
// Counts the arithmetic operations of a pixel. A copy of the kernel, compiled with a number type that counts its
// operations (core/kernel/prelude/counting.h), renders the pixel. The timed kernels do not count.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/render/kernel_scene.h"

namespace mandelmarch {

struct Operations {
    std::uint64_t additions = 0, multiplications = 0, divisions = 0, square_roots = 0;

    std::uint64_t total() const { return additions + multiplications + divisions + square_roots; }

    friend Operations operator+(Operations a, Operations b)
    {
        return {a.additions + b.additions, a.multiplications + b.multiplications, a.divisions + b.divisions,
                a.square_roots + b.square_roots};
    }
};

// Stages of rendering a pixel, in the kernel's order. `shade` does not include the computation of the normal.
enum class Stage { begin, march, refine, normal, shade };
inline constexpr int stage_count = 5;
inline constexpr std::array<const char*, stage_count> stage_names{"begin", "march", "refine", "normal", "shade"};

// Counts, summed over the pixels rendered.
struct PixelCount {
    std::array<Operations, stage_count> stages;
    Work work;  // from the kernel's own counters
    std::uint64_t hits = 0;
};

// DE iterations of each step of a ray, in order.
using RaySteps = std::vector<int>;

// A function that renders a pixel, adds its counts to `to`, and returns the steps of its ray.
template <class Real>
using CountOperations = RaySteps(const KernelScene<Real>& scene, int column, int row, PixelCount& to);

// Returns the function generated from operations.cpp.in for "FRACTAL_PRECISION" (cmake/Kernels.cmake), or nullptr if
// this build does not contain the fractal.
template <class Real>
CountOperations<Real>* operation_counter(std::string_view variant);

}  // namespace mandelmarch
