// SPDX-License-Identifier: Apache-2.0
// What a platform is: CPUs that share a name and differ in their design are two.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "bench/compare.h"
#include "bench/differences.h"
#include "bench/portability.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

Cpu read(const std::string& text)
{
    std::istringstream stream(text);
    return read_cpuinfo(stream);
}

Cpu epyc(int family, int model)
{
    return read("processor\t: 0\nvendor_id\t: AuthenticAMD\ncpu family\t: " + std::to_string(family) +
                "\nmodel\t\t: " + std::to_string(model) +
                "\nmodel name\t: AMD EPYC\nstepping\t: 1\nflags\t\t: fpu sse2 sme avx2 avx512f fma\n\nprocessor\t: 1\n"
                "model name\t: another\n");
}

TEST(Platform, HasFamilyAndModel)
{
    const Cpu cpu = epyc(25, 17);
    EXPECT_EQ(cpu.name, "AMD EPYC");
    EXPECT_EQ(cpu.vendor, "AuthenticAMD");
    EXPECT_EQ(cpu.platform(), "AMD EPYC (family 25 model 17)");
    EXPECT_EQ(cpu.stepping, 1);
    EXPECT_EQ(cpu.vectors, (std::vector<std::string>{"sse2", "avx2", "avx512f", "fma"}));
}

TEST(Platform, OfAnotherArchitectureIsItsName)
{
    const Cpu cpu = read("processor\t: 0\nFeatures\t: fp asimd sve2\nCPU implementer\t: 0x41\n");
    EXPECT_EQ(cpu.platform(), "CPU");
    EXPECT_FALSE(cpu.family.has_value());
    EXPECT_EQ(cpu.vectors, (std::vector<std::string>{"asimd", "sve2"}));
    EXPECT_EQ(read("").platform(), "CPU");
}

Result on(const Cpu& cpu, double seconds)
{
    Row row = made_row("openmp", std::vector<double>(9, seconds));
    row.platform = cpu.platform();
    row.device_name = cpu.name;
    return made_result({row});
}

TEST(Platform, TwoDesignsOfOneNameAreTwoPlatforms)
{
    const std::vector<Result> results{on(epyc(25, 17), 1), on(epyc(26, 2), 0.5)};
    ASSERT_EQ(portability(results).size(), 1U);
    EXPECT_EQ(portability(results)[0].platforms.size(), 2U);
    EXPECT_THROW(compare_results(results[0], results[1]), InputError);
    // The twin: by their names alone they would be one.
    std::vector<Result> by_name = results;
    for (Result& result : by_name) result.rows[0].platform = result.rows[0].device_name;
    EXPECT_EQ(portability(by_name)[0].platforms.size(), 1U);
}

TEST(Platform, CompareSaysWhereEnvironmentsDiffer)
{
    const auto environment = [](const char* revision, const char* flags, const char* driver) {
        return nlohmann::ordered_json{
            {"git", {{"revision", revision}, {"dirty", false}}},
            {"build", {{"compiler", "GNU 12"}, {"flags", flags}}},
            {"backends", {{{"name", "opencl"}, {"compiler", "x"}, {"devices", {{{"driver", driver}}}}}}}};
    };
    const auto same = environment("a", "-O3", "PoCL 3");
    EXPECT_TRUE(differences_of(same, same).empty());
    EXPECT_EQ(differences_of(same, environment("b", "-O2", "PoCL 4")),
              (std::vector<std::string>{"revision: a in the old result, b in the new",
                                        "compiler flags: -O3 in the old result, -O2 in the new",
                                        "driver of opencl 0: PoCL 3 in the old result, PoCL 4 in the new"}));
    // What an old file does not know is said, and any JSON in its place is read.
    EXPECT_EQ(differences_of({{"git", "none"}, {"backends", 5}}, {{"git", {{"revision", "b"}}}}),
              (std::vector<std::string>{"revision: unknown in the old result, b in the new"}));
}

}  // namespace
}  // namespace mandelmarch::bench
