// SPDX-License-Identifier: Apache-2.0
// Mutants of the models, whose kernel of the Mandelbox is wrong (CMakeLists.txt). Real backends pass the check. It must
// reject the mutants' Mandelbox, and accept their Mandelbulb, which is not changed.
#include <gtest/gtest.h>

#include <sstream>

#include "backends/all.h"
#include "bench/fidelity/equivalence.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

class Mutants : public testing::TestWithParam<std::string> {
protected:
    const Registry registry = all_backends();

    void SetUp() override
    {
        if (const auto why = registry.find(GetParam())->unavailable()) GTEST_SKIP() << *why;
    }

    // Renders one scene in both precisions.
    std::vector<bench::Tested> tested(const std::string& fractal)
    {
        const std::vector<NamedScene> scenes{{"official", official_scene(fractal, 90, 60)}};
        return bench::compare_backends(registry, {.backends = {GetParam()}, .others = scenes}).subjects;
    }
};

TEST_P(Mutants, AWrongFoldFails)
{
    for (const bench::Tested& one : tested("box")) EXPECT_EQ(one.wrong, one.pictures) << one.name();
}

TEST_P(Mutants, WithoutADefectTheyPass)
{
    int pictures = 0;
    for (const bench::Tested& one : tested("bulb")) {
        EXPECT_EQ(one.wrong, 0) << one.name();
        pictures += one.pictures;
    }
    EXPECT_GT(pictures, 0);
}

std::vector<std::string> names()
{
    std::istringstream list(MANDELMARCH_TESTED_MODELS);
    return {std::istream_iterator<std::string>(list), {}};
}

INSTANTIATE_TEST_SUITE_P(All, Mutants, testing::ValuesIn(names()), [](const auto& test) { return test.param; });

}  // namespace
}  // namespace mandelmarch
