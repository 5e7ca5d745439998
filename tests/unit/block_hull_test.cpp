// SPDX-License-Identifier: Apache-2.0
// openmp paints blocks that no ray of can meet the hull, and draws the same bytes as where it asks every ray.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <new>
#include <type_traits>

#include "backends/openmp/spacing.h"
#include "backends/openmp/threads.h"
#include "backends/openmp/variants.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

// All tiles of a picture, in rows.
struct TileList {
    int width;
    int height;
    int at = 0;

    static bool next(void* source, int& left, int& bottom)
    {
        auto& list = *static_cast<TileList*>(source);
        const int columns = (list.width + tile_side - 1) / tile_side;
        left = list.at % columns * tile_side;
        bottom = list.at / columns * tile_side;
        ++list.at;
        return bottom < list.height;
    }
};

struct Freed {
    void operator()(void* memory) const { ::operator delete (memory, std::align_val_t{64}); }
};

template <class Real>
struct Drawn {
    std::vector<unsigned char> bytes;
    openmp::Spent spent;
};

// The bytes of a picture by the best variant, with a block hull of `share` of what it is.
template <class Real>
Drawn<Real> draw(const Scene& scene, Mode mode, double share)
{
    const auto kernel = kernel_scene<KernelScene<Real>>(scene, mode, {});
    const auto variants = openmp::variants_of<Real>(scene.fractal->name, mode);
    const auto& variant = *std::ranges::find_if(variants.rbegin(), variants.rend(), &openmp::Variant<Real>::counted);
    const std::unique_ptr<void, Freed> memory(::operator new (variant.memory, std::align_val_t{64}));
    Drawn<Real> drawn;
    drawn.bytes.resize(3 * static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height));
    openmp::Notes<Real> notes;
    notes.fit(scene.width, scene.height);
    const openmp::Canvas<Real> canvas{
        .first_row = 0,
        .end_row = scene.height,
        .pixels = static_cast<std::ptrdiff_t>(scene.width) * scene.height,
        .spacing = openmp::spacing_of(kernel),
        .cones = false,  // they begin at the block hull, which changes where samples are
        .block_hull = static_cast<Real>(share) * openmp::block_hull_of(kernel, *scene.fractal),
        .lattice = {0, 1},
        .starts = notes.starts.data(),
        .hits = notes.hits.data(),
        .reals = nullptr,
        .wholes = nullptr,
        .bytes = drawn.bytes.data()};
    TileList tiles{scene.width, scene.height};
    drawn.spent = variant.draw(&kernel, canvas, {TileList::next, &tiles}, memory.get());
    return drawn;
}

std::vector<NamedScene> scenes()
{
    std::vector<NamedScene> all = random_scenes(12, 77);
    for (const char* name : {"bulb", "box"}) all.push_back({name, official_scene(name, 333, 217)});
    return all;
}

template <class Real>
void expect_same(Mode mode)
{
    for (const auto& [name, scene] : scenes()) {
        const Drawn<Real> painted = draw<Real>(scene, mode, 1);
        const Drawn<Real> asked = draw<Real>(scene, mode, 0);
        EXPECT_EQ(painted.bytes, asked.bytes) << name;
        EXPECT_EQ(painted.spent.steps, asked.spent.steps) << name;
    }
}

TEST(BlockHull, PaintsWhatNoRayHits)
{
    expect_same<float>(Mode::fast);
    expect_same<double>(Mode::fast);
    expect_same<float>(Mode::exact);
    expect_same<double>(Mode::exact);
}

// The twin: where blocks are asked for 0.9 of the hull, edges are cut off, so that blocks are painted indeed.
TEST(BlockHull, TooSmallCutsEdges)
{
    for (const Mode mode : {Mode::fast, Mode::exact}) {
        const Scene scene = official_scene("box", 333, 217);
        const auto kernel = kernel_scene<layout_f32::Scene>(scene, mode, {});
        const double share = 0.9 * kernel.hull / openmp::block_hull_of(kernel, *scene.fractal);
        EXPECT_NE(draw<float>(scene, mode, share).bytes, draw<float>(scene, mode, 0).bytes);
    }
}

}  // namespace
}  // namespace mandelmarch
