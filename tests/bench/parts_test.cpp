// SPDX-License-Identifier: Apache-2.0
// Parts of the wall time. The fraction that they leave unaccounted for is computed, and is reported if it is large.
#include <gtest/gtest.h>

#include "bench/result/figures.h"
#include "bench/files/result_file.h"
#include "bench/print/printers.h"
#include "tests/bench/made.h"

namespace mandelmarch::bench {
namespace {

// Returns a row whose parts leave the fraction `share` of the wall time unaccounted for.
Row leaving(double share)
{
    Row row = made_row("leaves", {0.1, 0.1, 0.1});
    for (Sample& s : row.samples) s.host = (1 - share) * s.wall - s.readback;
    return row;
}

bool is_named(const Row& row)
{
    return to_console(made_result({row}), false).find("leave more than 5.0%") != std::string::npos;
}

TEST(Parts, WhatTheyLeaveIsAFigure)
{
    const Row row = leaving(0.25);
    EXPECT_NEAR(made_result({row}).rows[0].figures->unaccounted.value(), 0.25, 1e-12);
}

TEST(Parts, ARowIsNamedWhereTheyLeaveMoreThanALittle)
{
    EXPECT_TRUE(is_named(leaving(0.06)));
    EXPECT_FALSE(is_named(leaving(0.04)));
}

// If a sample consists of several pictures from a fresh renderer, its wall time includes opening the device and
// building kernels, which are not among the sample's parts. So nothing is reported.
TEST(Parts, OfSeveralPicturesFromAFreshRendererNothingIsSaid)
{
    Row row = leaving(0.5);
    row.setting.frames = 10;
    EXPECT_FALSE(made_result({row}).rows[0].figures->unaccounted.has_value());
    EXPECT_FALSE(is_named(row));
}

}  // namespace
}  // namespace mandelmarch::bench
