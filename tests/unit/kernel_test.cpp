// SPDX-License-Identifier: Apache-2.0
// Tests the scalar kernel: its elementary functions, its gradients, and its entry points that work on stored rays.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/scenes.h"
#include "tests/unit/kernels.h"

namespace mandelmarch {
namespace {

// Returns |a - b| in units of epsilon * max(1, |b|).
double error_of(double a, double b, double epsilon) { return std::abs(a - b) / (epsilon * std::max(1.0, std::abs(b))); }

TEST(ElementaryFunctions, AgreeWithTheLibraryInDouble)
{
    constexpr double epsilon = 0x1p-52;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> splat(-50, 50);
    for (int i = 0; i < 200'000; ++i) {
        const double x = splat(random);
        const double y = splat(random);
        EXPECT_LT(error_of(bulb64::exponential(x) / std::exp(x), 1, epsilon), 3) << x;
        EXPECT_LT(error_of(bulb64::natural_log(std::exp(x)), std::log(std::exp(x)), epsilon), 2) << x;
        EXPECT_LT(error_of(bulb64::cosine_and_sine(20 * x).re, std::cos(20 * x), epsilon), 2) << x;
        EXPECT_LT(error_of(bulb64::cosine_and_sine(20 * x).im, std::sin(20 * x), epsilon), 2) << x;
        EXPECT_LT(error_of(bulb64::angle_of(y, x), std::atan2(y, x), epsilon), 3) << y << " " << x;
    }
    EXPECT_EQ(bulb64::angle_of(0, 0), 0);
    EXPECT_EQ(bulb64::natural_log(1), 0);
    EXPECT_LT(bulb64::natural_log(0), -1e29);
    EXPECT_EQ(bulb64::exponential(0), 1);
}

TEST(ElementaryFunctions, AgreeWithTheLibraryInFloat)
{
    constexpr double epsilon = 0x1p-23;
    std::mt19937 random(2);
    std::uniform_real_distribution<float> splat(-50, 50);
    for (int i = 0; i < 200'000; ++i) {
        const float x = splat(random);
        const float y = splat(random);
        EXPECT_LT(error_of(double{box32::exponential(x)} / std::exp(double{x}), 1, epsilon), 3) << x;
        EXPECT_LT(error_of(box32::natural_log(std::exp(x)), std::log(double{std::exp(x)}), epsilon), 2) << x;
        EXPECT_LT(error_of(box32::cosine_and_sine(10 * x).re, std::cos(double{10 * x}), epsilon), 2) << x;
        EXPECT_LT(error_of(box32::cosine_and_sine(10 * x).im, std::sin(double{10 * x}), epsilon), 2) << x;
        EXPECT_LT(error_of(box32::angle_of(y, x), std::atan2(double{y}, double{x}), epsilon), 3) << y << " " << x;
    }
}

TEST(ElementaryFunctions, WholePowersAgreeWithTheLibrary)
{
    for (int n = 1; n < 40; ++n) {
        EXPECT_NEAR(bulb64::raised_real(1.1, n) / std::pow(1.1, n), 1, 1e-13) << n;
        const bulb64::Complex c = bulb64::raised(bulb64::complex_number(0.6, 0.8), n);
        EXPECT_NEAR(c.re, std::cos(n * std::atan2(0.8, 0.6)), 1e-13) << n;
        EXPECT_NEAR(c.im, std::sin(n * std::atan2(0.8, 0.6)), 1e-13) << n;
    }
    EXPECT_EQ(bulb64::raised_real(3, 0), 1);
}

struct Gradients {
    int hits = 0;
    int off = 0;  // hits at which the analytic gradient is not parallel to that from central differences
};

// Compares the analytic gradients with those from central differences, at the visible points of 40 x 40 pixels.
template <class KernelScene>
Gradients gradients(const KernelScene& k)
{
    Gradients found;
    for (int i = 0; i < 40 * 40; ++i) {
        const auto ray = march(k, begin(k, i % 40, i / 40), 8000);
        if (!has_hit(k, ray)) continue;
        ++found.hits;
        const auto p = point_at(k, ray, ray.last_t * 0.999);
        const auto analytic = unit(gradient(k, p, true));
        found.off += !(dot3(analytic, normal_by_differences(k, p, true).direction) > 1 - 1e-6);
    }
    EXPECT_GT(found.hits, 100);
    return found;
}

// The scenes have few iterations, because their estimates are then smooth enough for finite differences.
TEST(Gradient, AgreesWithDifferences)
{
    Scene scene = official_scene("bulb", 40, 40);
    scene.iterations = 6;
    for (const double power : {8.0, 3.0, 7.5}) {
        scene.shape[2] = power;
        EXPECT_EQ(gradients(scene_for_kernel<bulb64::Scene>(scene)).off, 0) << power;
    }
    scene = official_scene("julia", 40, 40);
    scene.iterations = 8;
    EXPECT_EQ(gradients(scene_for_kernel<julia64::Scene>(scene)).off, 0);
    scene = official_scene("box", 40, 40);
    scene.iterations = 6;
    const Gradients box = gradients(scene_for_kernel<box64::Scene>(scene));
    EXPECT_LE(box.off, box.hits / 100);  // differences across a fold mix two slopes
}

// If a ray is stored after any number of steps and later continued, its pixel is the same as without interruption.
TEST(StagedEntries, DrawWhatTheWholePixelDraws)
{
    for (const int canonical : {0, 1}) {
        auto k = scene_for_kernel<bulb64::Scene>(official_scene("bulb", 30, 20));
        k.canonical = canonical;
        for (int i = 0; i < 30 * 20; ++i) {
            const bulb64::Pixel whole = bulb64::draw(k, i % 30, i / 30);
            bulb64::Ray ray = bulb64::begin(k, i % 30, i / 30);
            for (int pass = 0; bulb64::marching(k, ray); ++pass) ray = bulb64::march(k, ray, 1 + pass % 3);
            bulb64::Hit hit = bulb64::stopped(k, ray);
            for (int tries = 0; canonical != 0 && tries < 60; tries += 5) hit = bulb64::refine_by(k, hit, 5);
            const bulb64::Pixel staged = bulb64::shade(k, hit);
            EXPECT_EQ(whole.depth, staged.depth) << i;
            EXPECT_EQ(whole.colour.x, staged.colour.x) << i;
            EXPECT_EQ(whole.steps, staged.steps) << i;
            EXPECT_EQ(whole.iterations, staged.iterations) << i;
        }
    }
}

// Rays find the same root with another step factor. At most one ray in a hundred may be an exception, because a longer
// step may cross a short interval in which the estimate is below the tolerance.
TEST(CanonicalHit, IsTheSameRootWhateverTheStride)
{
    auto k = scene_for_kernel<box64::Scene>(official_scene("box", 30, 30));
    k.canonical = 1;
    k.root_share = 0.001;
    auto slow = k;
    slow.step_factor = slow.relaxation = 0.5;
    int hits = 0;
    int off = 0;
    for (int i = 0; i < 30 * 30; ++i) {
        const double t = box64::draw(k, i % 30, i / 30).depth;
        if (std::isinf(t)) continue;
        ++hits;
        off += std::abs(box64::draw(slow, i % 30, i / 30).depth - t) > 0.01 * k.tolerance * t;
    }
    EXPECT_GT(hits, 100);
    EXPECT_LE(off, hits / 100);
}

}  // namespace
}  // namespace mandelmarch
