// SPDX-License-Identifier: Apache-2.0
// The longest time that a camera stands still. The result equals that of an exhaustive search, with an amount of work
// that is proportional to the number of frames.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "flight/audit/motion.h"

namespace mandelmarch {
namespace {

Stand plain_search(const std::vector<Vector>& places, const std::vector<double>& radii)
{
    Stand longest;
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::size_t j = i;
        while (j + 1 < places.size() && length(places[j + 1] - places[i]) <= radii[i]) ++j;
        if (j - i > longest.steps) longest = {i, j - i, 0};
    }
    return longest;
}

TEST(Standing, IsWhatAPlainSearchFinds)
{
    std::mt19937 random(5);
    const auto draw = [&](double most) { return most * static_cast<double>(random() % 1000) / 1000; };
    for (int round = 0; round < 300; ++round) {
        std::vector<Vector> places{{0, 0, 0}};
        std::vector<double> radii;
        const double step = draw(0.5);
        while (places.size() < 2 + random() % 200) {
            // At random, the camera stands still, jumps, comes back to an earlier place, or moves on.
            const Vector last = places.back();
            const auto what = random() % 8;
            places.push_back(what == 0   ? places[random() % places.size()]
                             : what == 1 ? last + Vector{draw(3), 0, 0}
                             : what < 5  ? last
                                         : last + Vector{draw(step), draw(step), -draw(step)});
        }
        for (std::size_t i = 0; i < places.size(); ++i) radii.push_back(draw(1));
        const Stand found = longest_stand(places, radii);
        const Stand expected = plain_search(places, radii);
        EXPECT_EQ(found.first, expected.first);
        EXPECT_EQ(found.steps, expected.steps);
    }
}

TEST(Standing, TakesWorkThatGrowsWithTheFrames)
{
    constexpr std::size_t length = 200'000;
    const std::vector<double> radii(length, 1);
    const auto work = [&](auto place) {
        std::vector<Vector> places;
        for (std::size_t i = 0; i < length; ++i) places.push_back(place(i));
        return longest_stand(places, radii).distances;
    };
    // Cameras that always stand still, mostly stand still but jump, move, and move slowly.
    EXPECT_LT(work([](std::size_t) { return Vector{1, 2, 3}; }), 4 * length);
    EXPECT_LT(work([](std::size_t i) { return Vector{i % 20'001 == 20'000 ? 2.0 : 0.0, 0, 0}; }), 4 * length);
    EXPECT_LT(work([](std::size_t i) { return Vector{0.3 * static_cast<double>(i), 0, 0}; }), 4 * length);
    EXPECT_LT(work([](std::size_t i) { return Vector{0.00003 * static_cast<double>(i), 0, 0}; }), 4 * length);
}

}  // namespace
}  // namespace mandelmarch
