// SPDX-License-Identifier: Apache-2.0
// If all rays of a subtile miss the hull, openmp fills the subtile without marching. The bytes must be the same as if
// each ray were tested against the hull.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "backends/openmp/picture.h"
#include "backends/openmp/threads.h"
#include "backends/openmp/variants.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

template <class Real>
struct Drawn {
    std::vector<unsigned char> bytes;
    openmp::WorkCounts spent;
};

// Renders the bytes of a picture with the widest packs that count. `share` scales the hull against which openmp tests
// whole subtiles; 0: openmp tests each ray instead.
template <class Real>
Drawn<Real> draw(const Scene& scene, Mode mode, double share)
{
    const auto variants = openmp::variants_of<Real>(scene.fractal->name, mode);
    const auto& variant = *std::ranges::find_if(variants.rbegin(), variants.rend(), &openmp::Variant<Real>::counted);
    Drawn<Real> drawn;
    drawn.bytes.resize(3 * Image::pixels(scene.width, scene.height));
    openmp::LatticeBuffers<Real> notes;
    openmp::Picture<Real> picture(scene, mode, {}, variant, notes);
    const Band band{.first_row = 0, .rows = scene.height};
    openmp::Canvas<Real> canvas = picture.canvas({0, 1}, band, {.bytes = drawn.bytes.data()});
    canvas.cones = false;  // cones start at the subtiles' hull; with them, scaling the hull changes the samples
    KernelScene<Real> kernel = picture.kernel_scene();
    kernel.subtile_hull *= static_cast<Real>(share);
    openmp::TileQueue queue(scene.width, band, 1);
    openmp::TileQueue::Share tiles{queue};
    openmp::ThreadMemory memory;
    drawn.spent = variant.draw(kernel, canvas, tiles.tiles(), memory.of_size(variant.memory));
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

// Negative control: if the block hull is scaled to 0.9 of its size, edges of the fractal are cut off. This shows that
// openmp does fill whole subtiles.
TEST(BlockHull, TooSmallCutsEdges)
{
    for (const Mode mode : {Mode::fast, Mode::exact}) {
        const Scene scene = official_scene("box", 333, 217);
        const auto kernel = kernel_scene<layout_f32::Scene>(scene, mode, {});
        const double share = 0.9 * kernel.hull / kernel.subtile_hull;
        EXPECT_NE(draw<float>(scene, mode, share).bytes, draw<float>(scene, mode, 0).bytes);
    }
}

}  // namespace
}  // namespace mandelmarch
