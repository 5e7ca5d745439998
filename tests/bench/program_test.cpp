// SPDX-License-Identifier: Apache-2.0
// Runs bench with broken backends. A backend whose picture is wrong must not get a speed, and the exit code must be 1.
// The same backends pass if they have no defect.
#include "bench/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "backends/all.h"
#include "bench/command/outputs.h"
#include "bench/result/result_file.h"
#include "core/os/files.h"
#include "core/text/error.h"
#include "tests/bench/broken_backend.h"

namespace mandelmarch::bench {
namespace {

struct Ran {
    int code = 0;
    std::string out, err;
    nlohmann::ordered_json json;
};

// Runs bench in this process, with a backend that has this defect.
Ran run(Defect defect, std::vector<std::string> arguments)
{
    std::vector<std::unique_ptr<Backend>> backends;
    backends.push_back(make_reference_backend());
    backends.push_back(make_openmp_backend());
    backends.push_back(std::make_unique<BrokenBackend>(defect));
    const TemporaryFolder folder;
    const std::string file = folder.path() / "result.json";
    arguments.insert(arguments.begin(), "bench");
    if (std::ranges::find(arguments, "--list") == arguments.end()) {
        arguments.insert(arguments.end(), {"--json", file});
    }
    std::vector<char*> argv;
    for (std::string& word : arguments) argv.push_back(word.data());
    Ran ran;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    try {
        ran.code = bench_program(Registry(std::move(backends)), static_cast<int>(argv.size()), argv.data());
    } catch (const InputError& error) {
        ran.code = exit_usage;
        ran.err = error.what();
    } catch (const Unavailable& error) {
        ran.code = exit_unavailable;
        ran.err = error.what();
    }
    ran.out = testing::internal::GetCapturedStdout();
    ran.err += testing::internal::GetCapturedStderr();
    if (std::filesystem::exists(file)) ran.json = json_of(read_result(file));
    return ran;
}

std::vector<std::string> small(const std::string& mode)
{
    return {"--size", "48x40", "--fractal", "box", "--precision", "float", "--mode", mode, "--repetitions", "2"};
}

nlohmann::ordered_json row_of(const Ran& ran, const std::string& backend)
{
    for (const auto& row : ran.json["rows"]) {
        if (row["backend"] == backend) return row;
    }
    return {};
}

TEST(BenchProgram, EveryRowHasASpeedWithoutADefect)
{
    for (const char* mode : {"exact", "fast"}) {
        const Ran ran = run(Defect::none, small(mode));
        EXPECT_EQ(ran.code, exit_success) << ran.err;
        const auto row = row_of(ran, "broken");
        EXPECT_TRUE(row["verification"]["passed"]);
        EXPECT_EQ(row["samples"].size(), 2U);
        EXPECT_FALSE(row["figures"].is_null());
        EXPECT_EQ(ran.out.find("FAILED"), std::string::npos);
    }
}

class BrokenPicture : public testing::TestWithParam<Defect> {};

TEST_P(BrokenPicture, ShowsNoSpeedAndExitsOne)
{
    const Ran ran = run(GetParam(), small("exact"));
    EXPECT_EQ(ran.code, exit_failure);
    const auto row = row_of(ran, "broken");
    EXPECT_FALSE(row["failure"].is_null());
    EXPECT_TRUE(row["samples"].empty());
    EXPECT_TRUE(row["figures"].is_null());
    EXPECT_NE(ran.out.find("FAILED"), std::string::npos) << ran.out;
    EXPECT_NE(ran.err.find("mandelbox/float/exact/broken/0"), std::string::npos) << ran.err;
    // bench still times the other backends.
    EXPECT_EQ(row_of(ran, "openmp")["samples"].size(), 2U);
}

INSTANTIATE_TEST_SUITE_P(Defects, BrokenPicture,
                         testing::Values(Defect::one_byte, Defect::not_a_number, Defect::upside_down,
                                         Defect::wrong_later, Defect::stale, Defect::dies_later));

TEST(BenchProgram, FewPixelsMayDifferInFastMode)
{
    EXPECT_EQ(run(Defect::one_byte, small("fast")).code, exit_success);
    EXPECT_EQ(run(Defect::upside_down, small("fast")).code, exit_failure);
    EXPECT_EQ(run(Defect::not_a_number, small("fast")).code, exit_failure);
}

// `--without refinement` changes the picture slightly. Therefore bench then verifies only that the same pixels hit the
// fractal, and that all values are finite.
TEST(BenchProgram, AblationVerifiesHits)
{
    const auto without = [](const Ran& ran, const std::string& technique) {
        for (const auto& row : ran.json["rows"]) {
            if (row["backend"] == "broken" && row["setting"]["without"] == technique) return row;
        }
        return nlohmann::ordered_json{};
    };
    std::vector<std::string> arguments = small("fast");
    arguments.insert(arguments.end(), {"--study", "ablation"});
    const Ran sound = run(Defect::none, arguments);
    EXPECT_EQ(sound.code, exit_success) << sound.err;
    EXPECT_TRUE(without(sound, "refinement")["verification"]["passed"]);
    EXPECT_GT(without(sound, "refinement")["verification"]["visibly_differing"],
              without(sound, "")["verification"]["visibly_differing"]);
    EXPECT_FALSE(without(sound, "refinement")["figures"].is_null());
    // `--without gradient` computes normals from finite differences. It is unavailable in float, which is too
    // imprecise.
    EXPECT_NE(without(sound, "gradient")["unavailable"], "");
    for (const Defect defect : {Defect::upside_down, Defect::not_a_number}) {
        const Ran broken = run(defect, arguments);
        EXPECT_EQ(broken.code, exit_failure);
        EXPECT_FALSE(without(broken, "refinement")["verification"]["passed"]);
    }
}

TEST(BenchProgram, UnavailableBackendIsARow)
{
    const Ran ran = run(Defect::hidden, small("exact"));
    EXPECT_EQ(ran.code, exit_success);
    EXPECT_NE(ran.out.find("unavailable: hidden on purpose"), std::string::npos) << ran.out;
    EXPECT_EQ(row_of(ran, "broken")["unavailable"], "hidden on purpose");
    std::vector<std::string> one = small("exact");
    one.insert(one.end(), {"--backend", "broken"});
    const Ran alone = run(Defect::hidden, one);
    EXPECT_EQ(alone.code, exit_unavailable);
    EXPECT_NE(alone.err.find("hidden on purpose"), std::string::npos);
}

TEST(BenchProgram, DeviceThatLacksAPrecisionIsARow)
{
    const Ran ran =
        run(Defect::refuses, {"--size", "32x32", "--fractal", "box", "--mode", "exact", "--repetitions", "1"});
    EXPECT_EQ(ran.code, exit_success);
    EXPECT_NE(ran.out.find("unavailable: it has no double"), std::string::npos) << ran.out;
}

TEST(BenchProgram, WrongArgumentsExitTwo)
{
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"--backend", "nosuch"},
                                               {"--fractal", "nosuch"},
                                               {"--precision", "half"},
                                               {"--size", "10"},
                                               {"--budget", "nan"},
                                               {"--study", "nosuch"},
                                               {"--filter=a,,b"},
                                               {"--filter=" + std::string(20'000, '(')}}) {
        EXPECT_EQ(run(Defect::none, arguments).code, exit_usage) << arguments.front();
    }
}

TEST(BenchProgram, LinesAreAtMost120Characters)
{
    for (const Defect defect : {Defect::none, Defect::upside_down, Defect::hidden}) {
        std::istringstream out(run(defect, small("exact")).out);
        for (std::string line; std::getline(out, line);) EXPECT_LE(line.size(), 120U) << line;
    }
    std::istringstream out(
        run(Defect::none, {"--size", "32x32", "--study", "threads", "--fractal", "box", "--repetitions", "1"}).out);
    for (std::string line; std::getline(out, line);) EXPECT_LE(line.size(), 120U) << line;
}

// Returns the number of configurations of the study threads that the filter selects.
std::ptrdiff_t selected(const std::string& filter)
{
    std::istringstream out(run(Defect::none, {"--study", "threads", "--list", "--filter", filter}).out);
    std::ptrdiff_t count = 0;
    for (std::string line; std::getline(out, line) && !line.empty();) count += line.starts_with("mandel") ? 1 : 0;
    return count;
}

TEST(BenchProgram, FilterSelectsByPartsOrWholeNames)
{
    const std::ptrdiff_t all = selected("threads=");
    const std::ptrdiff_t one = selected("*/threads=1");
    EXPECT_GT(one, 0);
    EXPECT_EQ(selected("threads=1,bulb,box"), all) << "any of the parts";
    EXPECT_EQ(selected("-*/threads=1"), all - one);
    EXPECT_EQ(selected("mandelbox"), selected("mandelbox*"));
    EXPECT_EQ(selected("box*"), 0) << "a pattern must match the whole name";
    EXPECT_EQ(selected("*" + std::string("a*a*a*a*a*a*a*a*a*a*a*a*a*a*a*a*") + "x"), 0) << "in little time";
}

// bench writes into the project's folder of results only if all its sources are committed.
TEST(Outputs, KeptResultsOfChangedSourcesAreRefused)
{
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const std::string kept = (folder.path() / "kept").string();
    const std::string link = (folder.path() / "link.json").string();
    fs::create_directories(kept + "/machine");
    fs::create_symlink(kept + "/a.json", link);
    for (const std::string& path : {kept + "/a.json", kept + "/machine/../machine/a.json", link}) {
        EXPECT_THROW(refuse_kept_result(path, kept, true), InputError) << path;
        EXPECT_NO_THROW(refuse_kept_result(path, kept, false)) << "nothing has changed";
    }
    EXPECT_NO_THROW(refuse_kept_result(kept + "_elsewhere/a.json", kept, true)) << "a folder with a longer name";
}

}  // namespace
}  // namespace mandelmarch::bench
