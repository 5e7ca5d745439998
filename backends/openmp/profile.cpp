// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/profile.h"

#include <algorithm>
#include <chrono>

#include "backends/openmp/picture.h"
#include "backends/openmp/threads.h"
#include "backends/openmp/variants.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"

namespace mandelmarch::openmp {
namespace {

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

template <class Real>
class ProfilerOf : public Profiler {
public:
    ProfilerOf(const Scene& scene, Mode mode)
        : variant_(variants_of<Real>(scene.fractal->name, mode).back()),
          picture_(scene, mode, {.shared_occlusion = false}, variant_, notes_),
          rows_(rows_per_band(scene, band_limits))
    {
        if (variant_.profile == nullptr)
            throw Unavailable("backend openmp: it has no packs on this machine, only scalars");
    }

    StageSeconds draw(Image& image) override
    {
        StageSeconds seconds;
        void* const profile_memory = profile_memory_.of_size(variant_.profile_memory);
        each_lattice(image, [&](const Canvas<Real>& canvas, const Tiles& tiles) {
            variant_.profile(picture_.kernel_scene(), canvas, tiles, profile_memory, &now, seconds.of.data());
        });
        // Renders the picture a second time without a clock, into another image, so that `image` keeps the profiled
        // picture.
        Image whole(image.width(), image.height(), Image::Layers::bytes);
        void* const memory = memory_.of_size(variant_.memory);
        const double start = now();
        each_lattice(whole, [&](const Canvas<Real>& canvas, const Tiles& tiles) {
            variant_.draw(picture_.kernel_scene(), canvas, tiles, memory);
        });
        seconds.in_one_go = now() - start;
        return seconds;
    }

private:
    // Calls draw() for each lattice of each band. The bands are the same as those of the renderer, because the start of
    // rays near a band's edge depends on where the edge is.
    template <class Draw>
    void each_lattice(Image& image, Draw draw)
    {
        for (int row = 0; row < image.height(); row += rows_) {
            const Band band{.first_row = row, .rows = std::min(rows_, image.height() - row)};
            unsigned char* const bytes = image.bytes().data() + 3 * Image::pixels(image.width(), row);
            for (const Lattice& lattice : picture_.lattices()) {
                TileQueue queue(image.width(), band, 1);
                TileQueue::Share share{queue};
                draw(picture_.canvas(lattice, band, {.bytes = bytes}), share.tiles());
            }
        }
    }

    Variant<Real> variant_;
    LatticeBuffers<Real> notes_;
    Picture<Real> picture_;
    int rows_;
    ThreadMemory profile_memory_;
    ThreadMemory memory_;
};

}  // namespace

std::unique_ptr<Profiler> make_profiler(const Scene& scene, Precision precision, Mode mode)
{
    if (precision == Precision::f32) return std::make_unique<ProfilerOf<float>>(scene, mode);
    return std::make_unique<ProfilerOf<double>>(scene, mode);
}

}  // namespace mandelmarch::openmp
