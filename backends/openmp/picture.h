// SPDX-License-Identifier: Apache-2.0
// A picture being rendered: the kernel's scene, values derived from it, and the canvases.
#pragma once

#include <cstddef>
#include <vector>

#include "backends/openmp/variant.h"
#include "core/image/image.h"
#include "core/render/backend.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/render/spacing.h"
#include "core/scene/fractal.h"

namespace mandelmarch::openmp {

// Buffers in which the rays of one lattice leave values for the rays of later lattices (see Canvas). Reused between
// pictures.
template <class Real>
struct LatticeBuffers {
    std::vector<Real> block_start;
    std::vector<Real> neighbour_depth;
    std::vector<Real> along_normal, sunwards;

    void fit(int width, int rows, bool shares)
    {
        const auto blocks = static_cast<std::size_t>(tiles_of(width, rows, subtile_side));
        const std::size_t depths = Image::pixels(width, rows) / 2 + 1;
        if (block_start.size() < blocks) block_start.resize(blocks);
        if (neighbour_depth.size() < depths) neighbour_depth.resize(depths);
        if (shares && sunwards.size() < depths) {
            along_normal.resize(depths);
            sunwards.resize(depths);
        }
    }
};

// Bands are large, because at the end of each one the threads run out of rays to fill their lanes. A pixel of a band
// needs 28 bytes in float, 44 in double.
inline constexpr Limits band_limits{.pixels_per_band = 1 << 21, .pixels_to_fill = 1 << 21};

// Destination of a band's pixels: `bytes`, or `reals` and `wholes` if `bytes` is null.
template <class Real>
struct Target {
    unsigned char* bytes = nullptr;
    Real* reals = nullptr;
    int* wholes = nullptr;
};

// Returns true if pixels may share occlusion with adjacent pixels. Requires that normals ignore details smaller than a
// tolerance, and that adjacent pixels are closer together than the shortest distance at which openness is evaluated
// (core/kernel/looks.h).
template <class KernelScene>
bool shares_surroundings(const Scene& scene, const KernelScene& kernel, const Techniques& techniques)
{
    constexpr double nearest_openness = 0.004;  // as a fraction of the distance from the camera
    return techniques.shared_occlusion && scene.smooth && look_of(scene) != nullptr &&
           kernel.spacing < nearest_openness;
}

template <class Real>
class Picture {
public:
    Picture(const Scene& scene, Mode mode, const Techniques& techniques, const Variant<Real>& variant,
            LatticeBuffers<Real>& notes)
        : scene_(mandelmarch::kernel_scene<KernelScene<Real>>(scene, mode, techniques)),
          notes_(notes),
          lattices_(lattices_of(scene_, *scene.fractal, techniques)),
          cones_(cones_pay(scene_, *scene.fractal, techniques)),
          shares_(variant.pack > 1 && lattices_.count > 1 && shares_surroundings(scene, scene_, techniques))
    {
    }

    const KernelScene<Real>& kernel_scene() const { return scene_; }
    // Returns the lattices of the picture, in rendering order.
    const Lattices& lattices() const { return lattices_; }

    // Returns the canvas of one lattice of a band. All lattices of a band must be finished before the next band begins.
    Canvas<Real> canvas(const Lattice& lattice, const Band& band, const Target<Real>& target)
    {
        notes_.fit(scene_.width, band.rows, shares_);
        return {.first_row = band.first_row,
                .end_row = band.first_row + band.rows,
                .pixels = static_cast<std::ptrdiff_t>(scene_.width) * band.rows,
                .cones = cones_,
                .lattice = lattice,
                .block_start = notes_.block_start.data(),
                .neighbour_depth = notes_.neighbour_depth.data(),
                .along_normal = shares_ ? notes_.along_normal.data() : nullptr,
                .sunwards = shares_ ? notes_.sunwards.data() : nullptr,
                .reals = target.reals,
                .wholes = target.wholes,
                .bytes = target.bytes};
    }

private:
    KernelScene<Real> scene_;
    LatticeBuffers<Real>& notes_;
    Lattices lattices_;
    bool cones_;
    bool shares_;
};

}  // namespace mandelmarch::openmp
