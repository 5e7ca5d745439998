// SPDX-License-Identifier: Apache-2.0
// CPUs with the same name but different designs are two platforms.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "bench/result/compare.h"
#include "bench/result/differences.h"
#include "bench/result/platforms.h"
#include "bench/result/portability.h"
#include "core/os/cpu.h"
#include "core/os/files.h"
#include "core/text/error.h"
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

TEST(Platform, IsTheNameOnAnotherArchitecture)
{
    const Cpu cpu = read("processor\t: 0\nFeatures\t: fp asimd sve2\nCPU implementer\t: 0x41\nCPU part\t: 0xd4f\n");
    EXPECT_EQ(cpu.platform(), "ARM Neoverse V2");
    EXPECT_EQ(cpu.vendor, "ARM");
    EXPECT_FALSE(cpu.family.has_value());
    EXPECT_EQ(cpu.vectors, (std::vector<std::string>{"asimd", "sve2"}));
    EXPECT_EQ(read("").platform(), "CPU");
    const Cpu other = read("processor\t: 0\nCPU implementer\t: 0x99\nCPU part\t: 0x123\n");
    EXPECT_EQ(other.name, "ARM implementer 0x99 part 0x123");
    EXPECT_EQ(other.vendor, "ARM");
}

Result on(const Cpu& cpu, double seconds)
{
    Row row = made_row("openmp", std::vector<double>(9, seconds));
    row.platform = cpu.platform();
    row.device_name = cpu.name;
    return made_result({row});
}

// Returns a result with the given environment and peak.
Result machine(const nlohmann::ordered_json& cpu, double peak)
{
    Result result = on(epyc(26, 2), 1);
    result.environment["cpu"] = cpu;
    result.peaks.push_back({result.rows[0].platform, "openmp", 0, Precision::f32, peak});
    return result;
}

std::size_t platforms(const Result& a, const Result& b)
{
    const std::vector<Result> both{a, b};
    return portability(both).at(0).platforms.size();
}

TEST(Platform, OfOneNameWithTwiceThePeakIsTwo)
{
    const Result slow = machine({}, 231e9);
    EXPECT_EQ(platforms(slow, machine({}, 464e9)), 2U);
    EXPECT_EQ(platforms(slow, machine({}, 250e9)), 1U) << "a peak that was measured again";
    EXPECT_EQ(platforms(slow, machine({}, 0)), 1U) << "no peak is known";
    EXPECT_THROW(compare_results(slow, machine({}, 464e9)), InputError);
    EXPECT_EQ(compare_results(slow, machine({}, 250e9)).rows[0].verdict, Verdict::same);
    const std::vector<Result> apart = disambiguated(std::vector{slow, machine({}, 464e9), machine({}, 230e9)});
    EXPECT_EQ(apart[1].rows[0].platform, "AMD EPYC (family 26 model 2), machine 2");
    EXPECT_EQ(apart[1].peaks[0].platform, apart[1].rows[0].platform);
    EXPECT_EQ(apart[2].rows[0].platform, apart[0].rows[0].platform);
}

// Two results from one boot are from the same machine, even if their peaks differ, because another program's load may
// halve a peak.
TEST(Platform, OfOneBootIsOneWhateverItsPeaks)
{
    const auto booted = [](double peak, const char* boot) {
        Result result = machine({}, peak);
        result.environment["os"]["boot"] = boot;
        return result;
    };
    EXPECT_EQ(platforms(booted(231e9, "a"), booted(464e9, "a")), 1U);
    EXPECT_EQ(platforms(booted(231e9, "a"), booted(464e9, "b")), 2U);
    EXPECT_EQ(platforms(booted(231e9, "a"), machine({}, 464e9)), 2U) << "one boot is not known";
    Result gpu = booted(231e9, "a");
    gpu.rows[0].is_gpu = true;
    EXPECT_EQ(platforms(gpu, booted(464e9, "a")), 2U) << "a system has GPUs of many kinds";
}

TEST(Platform, WithOtherFactsIsAnother)
{
    const nlohmann::ordered_json cpu{{"stepping", 1},
                                     {"flags", {"avx2", "fma"}},
                                     {"caches", {{{"level", 3}, {"bytes", 33554432}}}},
                                     {"cores_usable", 2}};
    const Result one = machine(cpu, 100e9);
    EXPECT_EQ(platforms(one, one), 1U);
    for (const auto& [fact, value] : std::vector<std::pair<std::string, nlohmann::ordered_json>>{
             {"stepping", 2}, {"flags", {"avx2"}}, {"caches", nlohmann::ordered_json::array()}, {"cores_usable", 64}}) {
        nlohmann::ordered_json other = cpu;
        other[fact] = value;
        EXPECT_EQ(platforms(one, machine(other, 100e9)), 2U) << fact;
        other.erase(fact);
        EXPECT_EQ(platforms(one, machine(other, 100e9)), 1U) << fact << " is not known";
    }
}

TEST(Platform, IsTheSameIfFactsHaveAnotherOrder)
{
    const Result one = machine({{"flags", {"avx2", "fma"}}, {"caches", {{{"level", 3}, {"bytes", 1}}}}}, 100e9);
    Result other = machine({{"caches", {{{"bytes", 1}, {"level", 3}}}}, {"flags", {"fma", "avx2"}}}, 100e9);
    EXPECT_EQ(platforms(one, other), 1U);
    EXPECT_TRUE(differences_of(one.environment, other.environment).empty());
    other.environment["cpu"]["caches"][0]["bytes"] = 2;
    EXPECT_EQ(platforms(one, other), 2U);
}

TEST(Platform, CachesAreRead)
{
    namespace fs = std::filesystem;
    const TemporaryFolder made_folder;
    const fs::path& folder = made_folder.path();
    const auto cache = [&](int index, const char* level, const char* type, const char* size) {
        const fs::path made = folder / ("index" + std::to_string(index));
        fs::create_directories(made);
        for (const auto& [name, text] : {std::pair("level", level), {"type", type}, {"size", size}}) {
            std::ofstream(made / name) << text << '\n';
        }
        std::ofstream(made / "shared_cpu_list") << "0-7\n";
    };
    cache(0, "1", "Data", "48K");
    cache(1, "3", "Unified", "32M");
    const std::vector<Cache> caches = read_caches(folder.string());
    fs::remove_all(folder);
    ASSERT_EQ(caches.size(), 2U);
    EXPECT_EQ(caches[0].bytes, 48U << 10);
    EXPECT_EQ(caches[0].type, "Data");
    EXPECT_EQ(caches[1].level, 3);
    EXPECT_EQ(caches[1].bytes, 32U << 20);
    EXPECT_EQ(caches[1].cores, "0-7");
    EXPECT_TRUE(read_caches(folder.string()).empty());
}

TEST(Platform, DifferentFlagsAreListed)
{
    const auto lines = differences_of({{"cpu", {{"flags", {"avx2", "fma", "sse2"}}}}},
                                      {{"cpu", {{"flags", {"avx2", "avx512f", "sse2"}}}}});
    EXPECT_EQ(lines, std::vector<std::string>{"cpu/flags: fma in the old result only, avx512f in the new only"});
}

TEST(Platform, DifferencesOfEnvironmentsAreListed)
{
    const auto environment = [](const char* revision, const char* flags, const char* driver) {
        return nlohmann::ordered_json{
            {"git", {{"revision", revision}, {"dirty", false}}},
            {"build", {{"compiler", "GNU 12"}, {"flags", flags}}},
            {"backends",
             {{{"name", "opencl"}, {"compiler", "x"}, {"devices", {{{"name", "cpu"}, {"driver", driver}}}}}}}};
    };
    const auto same = environment("a", "-O3", "PoCL 3");
    EXPECT_TRUE(differences_of(same, same).empty());
    EXPECT_EQ(
        differences_of(same, environment("b", "-O2", "PoCL 4")),
        (std::vector<std::string>{"git/revision: a in the old result, b in the new",
                                  "build/flags: -O3 in the old result, -O2 in the new",
                                  "backends/opencl/devices/cpu/driver: PoCL 3 in the old result, PoCL 4 in the new"}));
    // A fact is called unknown if the old file lacks it.
    EXPECT_EQ(differences_of({{"backends", 5}, {"date", "1"}}, {{"git", {{"revision", "b"}}}, {"date", "2"}}),
              (std::vector<std::string>{"backends: 5 in the old result, unknown in the new",
                                        "git: unknown in the old result, {\"revision\":\"b\"} in the new"}));
}

}  // namespace
}  // namespace mandelmarch::bench
