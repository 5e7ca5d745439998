// SPDX-License-Identifier: Apache-2.0
// Energy of a simulated machine, and the state of its GPU.
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
class Energy : public testing::Test {
protected:
    Energy()
    {
        domain("intel-rapl:0", "package-0", "8500000");
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

TEST_F(Energy, IsThatOfThePackageSinceTheStart)
{
    Telemetry telemetry({.powercap = folder_, .nvml = "libnosuch.so"});
    EXPECT_EQ(telemetry.joules(), 0);
    write(folder_ / "intel-rapl:0" / "energy_uj", "500000");  // the counter has wrapped around
    EXPECT_NEAR(telemetry.joules().value(), 1, 1e-12);
    write(folder_ / "intel-rapl:0" / "energy_uj", "3000000");
    EXPECT_NEAR(telemetry.joules().value(), 3.5, 1e-12);
}

TEST_F(Energy, OfPackageAndGpuIsAdded)
{
    Telemetry telemetry({.powercap = folder_, .nvml = MANDELMARCH_NVML_STAND_IN});
    const double start = telemetry.joules().value();
    write(folder_ / "intel-rapl:0" / "energy_uj", "8600000");
    EXPECT_NEAR(telemetry.joules().value() - start, 2 + 0.1, 1e-9) << "2 J in each reading of the GPU";
}

TEST_F(Energy, WithoutACounterIsUnknown)
{
    Telemetry telemetry({.powercap = folder_ / "nosuch", .nvml = "libnosuch.so"});
    EXPECT_FALSE(telemetry.joules());
    EXPECT_EQ(telemetry.gpus()["missing"], "libnosuch.so is not installed");
}

// The stand-in (nvml.cpp) has another value for each reading.
TEST_F(Energy, StateOfAGpuIsThatOfNvml)
{
    const Telemetry telemetry({.powercap = folder_, .nvml = MANDELMARCH_NVML_STAND_IN});
    EXPECT_EQ(telemetry.gpus(),
              nlohmann::ordered_json::array(
                  {{{"name", "stand-in"}, {"watts", 141.873}, {"sm_megahertz", 1755.0}, {"throttled", "power cap"}}}));
}

}  // namespace
}  // namespace mandelmarch::bench
