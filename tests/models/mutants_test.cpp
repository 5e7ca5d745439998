// SPDX-License-Identifier: Apache-2.0
// Mutants of the models, whose kernel of the Mandelbox is wrong (CMakeLists.txt). Real backends pass the check. It must
// reject the mutants' Mandelbox, and accept their Mandelbulb, which is not changed.
#include <gtest/gtest.h>

#include <sstream>

#include "backends/all.h"
#include "core/base/error.h"
#include "tests/equivalence/equivalence.h"

namespace mandelmarch {
namespace {

class Mutants : public testing::TestWithParam<std::tuple<std::string, Precision>> {
protected:
    const Registry registry = all_backends();
    const Backend& mutant = *registry.find(std::get<0>(GetParam()));

    void SetUp() override
    {
        if (const auto why = mutant.unavailable()) GTEST_SKIP() << *why;
    }

    bool passes(const std::string& fractal)
    {
        Expected expected(registry);
        const std::vector<NamedScene> scenes{{"official", official_scene(fractal, 90, 60)}};
        return check(mutant, {.precision = std::get<1>(GetParam())}, fractal, scenes, expected).passed();
    }
};

TEST_P(Mutants, AWrongFoldFails) { EXPECT_FALSE(passes("box")); }

TEST_P(Mutants, WithoutADefectTheyPass) { EXPECT_TRUE(passes("bulb")); }

std::vector<std::string> names()
{
    std::istringstream list(MANDELMARCH_TESTED_MODELS);
    return {std::istream_iterator<std::string>(list), {}};
}

INSTANTIATE_TEST_SUITE_P(All, Mutants,
                         testing::Combine(testing::ValuesIn(names()), testing::Values(Precision::f64, Precision::f32)),
                         [](const auto& test) {
                             return std::get<0>(test.param) + "_" + std::string(name_of(std::get<1>(test.param)));
                         });

}  // namespace
}  // namespace mandelmarch
