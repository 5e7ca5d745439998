// SPDX-License-Identifier: Apache-2.0
// Telemetry of a simulated machine has values, or the reasons why they are missing.
#include "bench/measure/telemetry.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/os/files.h"

namespace mandelmarch::bench {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text << '\n'; }

// A folder like Linux' powercap interface, with the domains of a package and of its cores.
class MadeMachine : public testing::Test {
protected:
    void SetUp() override
    {
        domain("intel-rapl:0", "package-0", "1000000");
        domain("intel-rapl:0:0", "core", "500000");
        fs::create_directories(folder_ / "intel-rapl");  // the driver's own folder, which has no counter
    }

    void domain(const std::string& id, const std::string& name, const std::string& microjoules) const
    {
        fs::create_directories(folder_ / id);
        write(folder_ / id / "name", name);
        write(folder_ / id / "energy_uj", microjoules);
        write(folder_ / id / "max_energy_range_uj", "9000000");
    }

    const TemporaryFolder made_;
    const fs::path& folder_ = made_.path();
};

TEST_F(MadeMachine, EnergyIsWhatWasUsedSinceTheStart)
{
    const Telemetry telemetry({.powercap = folder_, .nvml = "libnosuch.so"});
    write(folder_ / "intel-rapl:0" / "energy_uj", "3500000");
    write(folder_ / "intel-rapl:0:0" / "energy_uj", "600000");
    const auto energy = telemetry.since_start()["energy"];
    ASSERT_EQ(energy["domains"].size(), 2U) << energy;
    EXPECT_EQ(energy["domains"][0]["name"], "intel-rapl:0 package-0");
    EXPECT_NEAR(energy["domains"][0]["joules"], 2.5, 1e-12);
    EXPECT_NEAR(energy["domains"][1]["joules"], 0.1, 1e-12);
    EXPECT_GE(energy["seconds"], 0);
}

TEST_F(MadeMachine, ACounterThatBeganAgainIsUnwrapped)
{
    write(folder_ / "intel-rapl:0" / "energy_uj", "8500000");
    const Telemetry telemetry({.powercap = folder_, .nvml = "libnosuch.so"});
    write(folder_ / "intel-rapl:0" / "energy_uj", "500000");
    EXPECT_NEAR(telemetry.since_start()["energy"]["domains"][0]["joules"], 1, 1e-12);
}

TEST_F(MadeMachine, WhatIsMissingIsSaid)
{
    const Telemetry telemetry({.powercap = folder_ / "nosuch", .nvml = "libnosuch.so"});
    const auto told = telemetry.since_start();
    EXPECT_EQ(told["energy"]["missing"], (folder_ / "nosuch").string() + " has no domain of RAPL");
    EXPECT_EQ(told["gpus"]["missing"], "libnosuch.so is not installed");
    EXPECT_FALSE(told["energy"].contains("domains"));
}

// The stand-in (nvml.cpp) has another value for each reading.
TEST_F(MadeMachine, AGpusReadingsAreThoseThatNvmlNames)
{
    const Telemetry telemetry({.powercap = folder_, .nvml = MANDELMARCH_NVML_STAND_IN});
    EXPECT_EQ(telemetry.since_start()["gpus"], nlohmann::ordered_json::array({{{"name", "stand-in"},
                                                                               {"joules", nullptr},
                                                                               {"watts", 141.873},
                                                                               {"celsius", 36.0},
                                                                               {"sm_megahertz", 1755.0},
                                                                               {"most_sm_megahertz", 1980.0},
                                                                               {"memory_megahertz", 2619.0},
                                                                               {"throttled", "power cap"}}}));
}

}  // namespace
}  // namespace mandelmarch::bench
