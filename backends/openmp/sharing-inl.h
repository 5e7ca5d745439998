// SPDX-License-Identifier: Apache-2.0
// Hits that take over what a look finds around them from the pixels beside them, drawn before, that see the same
// surface.

// Guard: once for each pack with pools.
#if defined(MM_SHARING_INL_H) == defined(MM_POOL_TOGGLE)
#ifdef MM_SHARING_INL_H
#undef MM_SHARING_INL_H
#else
#define MM_SHARING_INL_H
#endif

#include <cstddef>

#include "backends/openmp/drawing-inl.h"
#include "backends/openmp/rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mandelmarch::openmp {
namespace HWY_NAMESPACE {
namespace {
namespace MM_PACK {

// Chosen by how far pictures change (docs/notes/experiments.md).
constexpr MM_REAL same_surface =
    MM_REAL(0.02);                        // of a depth, at most: how far a depth on the same surface lies from it
constexpr MM_REAL enough = MM_REAL(0.3);  // of the weights around a pixel has to be on its surface

// Surroundings between the four pixels of even columns and rows around one, by their nearness, and the weight of those
// whose depth is that of the same surface.
struct Between {
    MM_REAL along_normal = 0;
    MM_REAL sunwards = 0;
    MM_REAL weight = 0;

    HWY_INLINE Between(const Canvas<MM_REAL>& canvas, int width, std::ptrdiff_t pixel, MM_REAL t)
    {
        const std::ptrdiff_t row = pixel / width;
        const std::ptrdiff_t column = pixel % width;
        const MM_REAL right = column % 2 != 0 ? MM_REAL(0.5) : MM_REAL(0);
        const MM_REAL above = row % 2 != 0 ? MM_REAL(0.5) : MM_REAL(0);
        const std::ptrdiff_t corner = ((row & ~1) * width + (column & ~1)) / 2;
        const bool is_right = right > 0 && column + 1 < width;
        const bool is_above = above > 0 && canvas.first_row + row + 1 < canvas.end_row;
        add(canvas, corner, (1 - right) * (1 - above), t);
        if (is_right) add(canvas, corner + 1, right * (1 - above), t);
        if (is_above) add(canvas, corner + width, (1 - right) * above, t);
        if (is_right && is_above) add(canvas, corner + width + 1, right * above, t);
        if (weight < enough) return;
        along_normal /= weight;
        sunwards /= weight;
    }

private:
    HWY_INLINE void add(const Canvas<MM_REAL>& canvas, std::ptrdiff_t at, MM_REAL share, MM_REAL t)
    {
        const MM_REAL apart = canvas.neighbour_depth[at] - t;
        if (!(apart < same_surface * t && -apart < same_surface * t)) return;
        weight += share;
        along_normal += share * canvas.along_normal[at];
        sunwards += share * canvas.sunwards[at];
    }
};

// Which of the first lanes, those that are on, share; what they share becomes theirs.
HWY_INLINE mask find_shared(const Drawing& d, Arrival& a, const mask& on)
{
    MM_REAL ts[register_lanes];
    Int pixels[register_lanes];
    MM_REAL along_normal[register_lanes] = {};
    MM_REAL sunwards[register_lanes] = {};
    MM_REAL weights[register_lanes] = {};
    store_lanes(a.hit.below_t, ts);
    store_lanes(a.pixel, pixels);
    const int lanes = lanes_on(on);
    for (int i = 0; i < lanes; ++i) {
        const Between between(d.canvas, d.scene.width, pixels[i], ts[i]);
        along_normal[i] = between.along_normal;
        sunwards[i] = between.sunwards;
        weights[i] = between.weight;
    }
    a.shared = {load_lanes(along_normal), load_lanes(sunwards)};
    return load_lanes(weights) >= real(enough);
}

// Whether pixels of this lattice take over surroundings: its neighbours are two pixels apart.
HWY_INLINE bool shares(const Drawing& d) { return d.canvas.sunwards != nullptr && d.canvas.lattice.before == 2; }

}  // namespace MM_PACK
}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace mandelmarch::openmp
HWY_AFTER_NAMESPACE();
#endif
