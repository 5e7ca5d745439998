// SPDX-License-Identifier: Apache-2.0
// openmp renders fast pictures lattice by lattice: the pixels in every fourth column and row, then in every second
// column and row, then all others. This lets rays start near the hits of neighbouring pixels. Every pixel must be
// rendered once. The picture must be nearly the same as if rays did not use their neighbours.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "backends/all.h"
#include "backends/openmp/picture.h"
#include "backends/openmp/threads.h"
#include "backends/openmp/variants.h"
#include "core/image/compare.h"
#include "core/render/registry.h"
#include "core/scene/fractal.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

using openmp::LatticeBuffers;

constexpr float not_drawn = -7;  // depth of pixels that are not rendered yet; no rendered pixel has it

// Returns true if the machine has packs.
bool has_packs() { return openmp::variants_of<float>("mandelbulb", Mode::fast).back().pack > 1; }

// A picture in float whose lattices the test renders one after the other, on one thread.
class DrawnLattices {
public:
    explicit DrawnLattices(const Scene& scene)
        : scene_(scene),
          variant_(counted_packs(scene)),
          picture_(scene, Mode::fast, {}, variant_, notes),
          pixels_(Image::pixels(scene.width, scene.height)),
          reals_(real_planes * pixels_, not_drawn),
          wholes_(whole_planes * pixels_)
    {
    }

    void draw(Lattice lattice)
    {
        const Band band{.first_row = 0, .rows = scene_.height};
        const openmp::Canvas<float> canvas =
            picture_.canvas(lattice, band, {.reals = reals_.data(), .wholes = wholes_.data()});
        openmp::TileQueue queue(scene_.width, band, 1);
        openmp::TileQueue::Share share{queue};
        openmp::ThreadMemory memory;
        steps_ += variant_.draw(picture_.kernel_scene(), canvas, share.tiles(), memory.of_size(variant_.memory)).steps;
    }

    float depth(int x, int y) const
    {
        return reals_[3 * pixels_ + static_cast<std::size_t>(y) * static_cast<std::size_t>(scene_.width) +
                      static_cast<std::size_t>(x)];
    }

    // Returns true if the number of steps that rays took equals the sum of the steps stored for all pixels. If a pixel
    // was rendered twice, rays took more steps than are stored.
    bool drawn_once() const
    {
        std::uint64_t steps = 0;
        for (std::size_t i = 0; i < pixels_; ++i) steps += static_cast<std::uint64_t>(wholes_[i]);
        return steps == steps_;
    }

    Image image() const
    {
        Image image(scene_.width, scene_.height, Image::Layers::all);
        const auto width = static_cast<std::size_t>(scene_.width);
        image.store(planes_of(reals_.data(), wholes_.data(), pixels_, width), 0, 0, scene_.width, scene_.height);
        return image;
    }

    LatticeBuffers<float> notes;

private:
    static openmp::Variant<float> counted_packs(const Scene& scene)
    {
        const auto variants = openmp::variants_of<float>(scene.fractal->name, Mode::fast);
        return *std::ranges::find_if(variants.rbegin(), variants.rend(),
                                     [](const auto& one) { return one.counted && one.pack > 1; });
    }

    Scene scene_;
    openmp::Variant<float> variant_;
    openmp::Picture<float> picture_;
    std::size_t pixels_;
    std::vector<float> reals_;
    std::vector<int> wholes_;
    std::uint64_t steps_ = 0;
};

constexpr Lattice lattices[] = {{0, 4}, {4, 2}, {2, 1}};

// Returns true if the rendered pixels are exactly those whose column and row are multiples of `apart`.
bool drawn_are_multiples(const DrawnLattices& drawn, const Scene& scene, int apart)
{
    for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
            const bool asked = x % apart == 0 && y % apart == 0;
            if (asked != (drawn.depth(x, y) != not_drawn)) return false;
        }
    }
    return true;
}

TEST(Neighbours, AreDrawnLatticeByLattice)
{
    if (!has_packs()) GTEST_SKIP() << "no vectors";
    std::vector<Scene> scenes;
    for (const char* name : {"bulb", "box"}) {
        for (const auto& [width, height] : {std::pair(333, 217), {64, 48}, {1, 1}, {5, 3}, {3, 18}, {17, 1}}) {
            scenes.push_back(official_scene(name, width, height));
        }
    }
    for (const NamedScene& named : random_scenes(10, 505)) scenes.push_back(named.scene);
    for (const Scene& scene : scenes) {
        DrawnLattices drawn(scene);
        for (const Lattice& lattice : lattices) {
            drawn.draw(lattice);
            EXPECT_TRUE(drawn_are_multiples(drawn, scene, lattice.apart))
                << scene.fractal->name << ", " << scene.width << " x " << scene.height << ", " << lattice.apart;
        }
        EXPECT_TRUE(drawn.drawn_once()) << scene.fractal->name << ", " << scene.width << " x " << scene.height;
        // Negative controls: one lattice is rendered twice, or one is not rendered.
        if (scene.width > 17) {
            drawn.draw(lattices[2]);
            EXPECT_FALSE(drawn.drawn_once());
        }
        if (scene.width > 1) {
            DrawnLattices incomplete(scene);
            incomplete.draw(lattices[0]);
            incomplete.draw(lattices[1]);
            EXPECT_FALSE(drawn_are_multiples(incomplete, scene, 1));
        }
    }
}

// Renders a picture lattice by lattice and compares it with a picture rendered without lattices. Before the last
// lattice, `change` modifies the depth of each neighbour.
Comparison off(const Scene& scene, const std::function<void(float& depth)>& change)
{
    DrawnLattices alone(scene);
    alone.draw({0, 1});
    DrawnLattices drawn(scene);
    for (const Lattice& lattice : lattices) {
        if (lattice.apart == 1) {
            for (float& depth : drawn.notes.neighbour_depth) change(depth);
        }
        drawn.draw(lattice);
    }
    return compare(alone.image(), drawn.image());
}

double percent(std::uint64_t count, const Comparison& c)
{
    return 100.0 * static_cast<double>(count) / static_cast<double>(c.pixels);
}

TEST(Neighbours, LeaveDepthsThatHoldBetweenThem)
{
    if (!has_packs()) GTEST_SKIP() << "no vectors";
    for (const char* name : {"bulb", "box"}) {
        const Scene scene = official_scene(name, 540, 540);
        const Comparison drawn = off(scene, [](float&) {});
        EXPECT_LE(percent(drawn.visibly_differing, drawn), 1) << name;
        EXPECT_LE(percent(drawn.hit_or_miss, drawn), 0.01) << name;
        // If the neighbours' depths are too large, rays start behind the surface. Such rays must start again.
        const float tolerance = std::pow(10.0F, static_cast<float>(scene.detail));
        const Comparison late = off(scene, [&](float& depth) { depth *= depth > 0 ? 1 + 4 * tolerance : 1; });
        EXPECT_LE(percent(late.visibly_differing, late), 2) << name;
        EXPECT_LE(percent(late.hit_or_miss, late), 0.02) << name;
        // Negative controls: the neighbours' depths are behind the fractal, or mark all neighbours as clear misses.
        const Comparison behind = off(scene, [](float& depth) { depth *= depth > 0 ? 10 : 1; });
        EXPECT_GT(percent(behind.hit_or_miss, behind), 10) << name;
        const Comparison clear = off(scene, [](float& depth) { depth = -1; });
        EXPECT_GT(percent(clear.hit_or_miss, clear), 10) << name;
    }
}

// Renders a picture of a film. A wall fills the picture up to the top row. The neighbours' values are stored for every
// second row of the picture. Before the last lattice, the values in the stored row `row` are replaced by those of the
// stored row below; `change` is added to the occlusion. The stored row 32, half the height, is just outside the
// picture.
Image with_surroundings(std::size_t row, float change)
{
    Scene scene = official_scene("bulb", 96, 64);
    scene.field_of_view *= 0.02;
    scene.colouring = 2;
    scene.smooth = true;
    DrawnLattices drawn(scene);
    drawn.draw(lattices[0]);
    drawn.draw(lattices[1]);
    const auto copy_row = [&](std::vector<float>& values, float more) {
        const std::size_t width = 96;
        values.resize(std::max(values.size(), (row + 1) * width));
        for (std::size_t i = row * width; i < (row + 1) * width; ++i) values[i] = values[i - width] + more;
    };
    copy_row(drawn.notes.neighbour_depth, 0);
    copy_row(drawn.notes.along_normal, change);
    copy_row(drawn.notes.sunwards, change);
    drawn.draw(lattices[2]);
    return drawn.image();
}

TEST(Neighbours, ShareNothingFromBeyondThePicture)
{
    if (!has_packs()) GTEST_SKIP() << "no vectors";
    EXPECT_EQ(compare(with_surroundings(32, 0), with_surroundings(32, 1)).differing, 0U);
    // Negative control: the stored row 31 is inside the picture, and a change of its values changes the picture.
    EXPECT_GT(compare(with_surroundings(31, 0), with_surroundings(31, 1)).differing, 50U);
}

// The random scenes are rendered at four times their size. Pixels are then close enough together, in tolerances, for
// rays to use their neighbours.
TEST(Neighbours, ChangeLittleAndSaveEstimates)
{
    if (!has_packs()) GTEST_SKIP() << "no vectors";
    const Registry registry = all_backends();
    for (const std::string fractal : {"bulb", "box"}) {
        Comparison all;
        Work with;
        Work without;
        for (const NamedScene& named : random_scenes(20, 606)) {
            if (named.scene.fractal->short_name != fractal) continue;
            Scene scene = named.scene;
            scene.width *= 4;
            scene.height *= 4;
            const auto drawn = [&](bool neighbours, Work& work) {
                const RendererOptions options{.mode = Mode::fast, .techniques = {.neighbours = neighbours}};
                Image image(scene.width, scene.height, Image::Layers::all);
                work.de_calls += registry.find("openmp")->create(options)->render(scene, image).work.de_calls;
                return image;
            };
            const Comparison one = compare(drawn(true, with), drawn(false, without));
            all.pixels += one.pixels;
            all.visibly_differing += one.visibly_differing;
            all.hit_or_miss += one.hit_or_miss;
        }
        EXPECT_LE(percent(all.visibly_differing, all), 1) << fractal;
        EXPECT_LE(percent(all.hit_or_miss, all), 0.01) << fractal;
        EXPECT_LT(with.de_calls, without.de_calls * 9 / 10) << fractal;
        EXPECT_GT(all.visibly_differing, 0U) << fractal;  // shows that rays did use their neighbours
    }
}

}  // namespace
}  // namespace mandelmarch
