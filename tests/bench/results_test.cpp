// SPDX-License-Identifier: Apache-2.0
// Result files: values that are read or rejected, derived quantities, and output in Google Benchmark's formats.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "bench/files/result_file.h"
#include "bench/print/printers.h"
#include "bench/base/statistics.h"
#include "core/base/error.h"
#include "made.h"

namespace mandelmarch::bench {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<double> seven{0.010, 0.013, 0.011, 0.019, 0.012, 0.017, 0.016};

Json whole() { return json_of(made_result({made_row("openmp", seven)})); }

std::string refusal_of(const std::string& text)
{
    try {
        static_cast<void>(parse_result(text, "file.json"));
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(ResultFile, IsReadAsItWasWritten) { EXPECT_EQ(json_of(parse_result(text_of(whole()), "file.json")), whole()); }

// Ratios are computed round by round, so that the slow third round cancels. There is no ratio of the reference, which
// does not run the kernel.
TEST(ResultFile, OtherBackendsStandBesideTheHosts)
{
    const Result result = made_result({made_row("openmp", {1, 1, 9, 1, 1, 1, 1}),
                                       made_row("vulkan", {3, 3, 27, 3, 3, 3, 3}), made_row("reference", seven)});
    const Json ratios = json_of(result)["questions"]["others_to_host"];
    ASSERT_EQ(ratios.size(), 1);
    EXPECT_EQ(ratios[0]["numerator"], "mandelbox/float/exact/vulkan/0");
    EXPECT_EQ(ratios[0]["denominator"], "mandelbox/float/exact/openmp/0");
    EXPECT_DOUBLE_EQ(ratios[0]["ratio"]["max"], 3);
}

// In the CSV, both the column application and the column backend distinguish the scalar kernel from the packs of the
// same backend.
TEST(ResultFile, TheScalarTextIsAnApplicationByItself)
{
    Row scalar = made_row("openmp", {9, 9, 9, 9, 9, 9});
    scalar.sweep_value = "simd-width=1";
    scalar.setting.simd_width = 1;
    const Result result = made_result({made_row("openmp", {1, 1, 1, 1, 1, 1}), scalar});
    const Json rows = json_of(result)["rows"];
    EXPECT_EQ(rows[0]["application"], "openmp");
    EXPECT_EQ(rows[1]["application"], "openmp-scalar");
    EXPECT_EQ(rows[1]["backend"], "openmp");
    const std::string csv = to_csv(result);
    EXPECT_NE(csv.find("\nmandelbox float exact 100x100,openmp-scalar,machine,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",float,exact,openmp-scalar,0,simd-width=1,"), std::string::npos) << csv;
    Result sweep = result;
    sweep.study = "simd-widths";
    EXPECT_NE(to_csv(derived(sweep)).find("\nmandelbox float exact 100x100 simd-width=1,openmp,"), std::string::npos);
}

// Ratios are computed round by round, so that slow rounds cancel. The pictures of the sweep have two aspect ratios. A
// row without a sweep value belongs to no sweep.
TEST(ResultFile, PointsOfASweepStandBesideTheFirstAndThePrevious)
{
    std::vector<Row> rows{made_row("openmp", {1, 1, 9, 1, 1, 1, 1}), made_row("openmp", {3, 3, 27, 3, 3, 3, 3}),
                          made_row("openmp", {5, 5, 45, 5, 5, 5, 5}), made_row("openmp", {12, 12, 108, 12, 12, 12, 12}),
                          made_row("openmp", seven)};
    for (std::size_t i = 0; i < 4; ++i) rows[i].sweep_value = "size=" + std::to_string(i);
    rows[2].setting.width = 177;
    const Json questions = json_of(made_result(std::move(rows)))["questions"];
    const Json& first = questions["to_first_value"];
    ASSERT_EQ(first.size(), 3);
    EXPECT_DOUBLE_EQ(first[0]["ratio"]["max"], 3);
    EXPECT_DOUBLE_EQ(first[2]["ratio"]["max"], 12);
    const Json& previous = questions["to_previous_value"];
    ASSERT_EQ(previous.size(), 2);
    EXPECT_DOUBLE_EQ(previous[0]["ratio"]["max"], 3);
    EXPECT_DOUBLE_EQ(previous[1]["ratio"]["max"], 4);
}

// Each error is one line with the file, the place and the value.
TEST(ResultFile, ValuesThatNoStudyHasAreRefused)
{
    const std::vector<std::pair<std::string, std::string>> changes{
        {"/rows/0/setting/width", "-5"},
        {"/rows/0/setting/height", "1e300"},
        {"/rows/0/setting/frames", "0.5"},
        {"/rows/0/samples/3/kernel", "\"0.1\""},
        {"/rows/0/samples/3/kernel", "null"},
        {"/rows/0/samples/3/wall", "1e300"},
        {"/rows/0/samples/3/run", "-1"},
        {"/rows/0/samples/3", "[]"},
        {"/rows/0/samples", "{}"},
        {"/rows/0/verification/passed", "1"},
        {"/rows/0/verification/pixels", "18446744073709551615"},
        {"/rows/0/work/steps", "-1"},
        {"/rows/0/precision", "\"half\""},
        {"/rows/0/mode", "7"},
        {"/rows/0/backend", "null"},
        {"/rows/0/operations", "-1"},
        {"/runs", "99999999999"},
        {"/runs", "true"},
        {"/seed", "-1"},
        {"/warnings", "[1]"},
        {"/environment", "[]"},
        {"/version", "\"1\""},
        {"/rows", "\"none\""}};
    for (const auto& [place, value] : changes) {
        Json json = whole();
        json[Json::json_pointer(place)] = Json::parse(value);
        const std::string said = refusal_of(text_of(json));
        EXPECT_TRUE(said.starts_with("file.json: ")) << place << " " << value << ": " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    }
    EXPECT_EQ(refusal_of(text_of(whole())), "");
    Json json = whole();
    json["rows"][0]["samples"][3]["kernel"] = "fast";
    EXPECT_EQ(refusal_of(text_of(json)),
              "file.json: rows[0].samples[3].kernel: \"fast\" given, expected a number from -1000000000 to "
              "1000000000, expected a result of bench --json");
}

TEST(ResultFile, BracketsThatAreTooDeepAreRefusedBeforeTheyAreParsed)
{
    const std::string deep = "{\"version\": " + std::string(1'000'000, '[');
    EXPECT_NE(refusal_of(deep).find("nested"), std::string::npos);
}

TEST(ResultFile, ARowThatIsThereTwiceIsRefused)
{
    Json json = whole();
    json["rows"].push_back(json["rows"][0]);
    EXPECT_NE(refusal_of(text_of(json)).find("mandelbox/float/exact/openmp/0 is there twice"), std::string::npos);
}

TEST(ResultFile, ALongTextIsCutInTheMessage)
{
    Json json = whole();
    json["version"] = std::string(5'000'000, 'x');
    EXPECT_LT(refusal_of(text_of(json)).size(), 300U);
}

Json with_counts()
{
    Result result = made_result({made_row("openmp", seven)});
    Counted counted;
    counted.fractal = "mandelbox";
    counted.setting.width = counted.setting.height = 100;
    counted.lane_use = {{16, {0.5, 0.25}, ActiveLanes{0.75, 0.5}, ActiveLanes{0.01, 0.02}, ActiveLanes{0.03, 0.04}}};
    counted.errors = {.per_iteration = 0.5, .per_estimate = 0.25};
    result.rows[0].operations = 1e9;
    result.rows[0].operations_error = 1e7;
    result.counts.push_back(counted);
    return json_of(derived(result));
}

TEST(ResultFile, LanesAreReadAsTheyWereWritten)
{
    const Json json = with_counts();
    EXPECT_EQ(json_of(parse_result(text_of(json), "file.json")), json);
}

// Results of version 1 have other words, and the oldest lack what later builds measured.
TEST(ResultFile, AnOldResultIsUpgraded)
{
    const Result read = parse_result(R"({"schema": "mandelmarch-bench", "version": 1, "study": "packs", "seed": 1,
        "launches": 1, "environment": {}, "warnings": [], "peaks": [], "stages": [],
        "counts": [{"fractal": "mandelbox", "precision": "float", "mode": "fast", "setting": {"width": 9, "height": 9,
            "iterations": 18, "detail": -3, "power": 1, "view": "official", "without": "root", "threads": 0, "pack": 0,
            "chunk": 0, "frames": 0}, "pixels": 81, "hits": 9, "work": {"steps": 9, "de_calls": 9, "iterations": 9},
            "stages": {"begin": {"sums": 1, "products": 2, "quotients": 3, "roots": 4},
                "march": {"sums": 1, "products": 2, "quotients": 3, "roots": 4},
                "refine": {"sums": 1, "products": 2, "quotients": 3, "roots": 4},
                "normal": {"sums": 1, "products": 2, "quotients": 3, "roots": 4},
                "shade": {"sums": 1, "products": 2, "quotients": 3, "roots": 4}},
            "march_de_calls": 9, "march_iterations": 9, "lanes": 16, "active_in_steps": 0.5,
            "active_in_iterations": 0.25}],
        "rows": [{"fractal": "mandelbox", "precision": "float", "mode": "fast", "backend": "openmp", "device": 0,
            "point": "pack=16", "setting": {"width": 9, "height": 9, "iterations": 18, "detail": -3, "power": 1,
            "view": "official", "without": "", "threads": 0, "pack": 16, "chunk": 0, "frames": 0}, "unavailable": null,
            "failure": null, "platform": "CPU", "device_name": "CPU", "vendor": "", "driver": "", "is_gpu": false,
            "instruction_set": "", "threads": 2, "pack": 16, "proof": {"drawn": true, "fine": true, "yardstick": false,
            "level": "same bits", "text": "same bits", "against": "openmp --pack 1", "pixels": 81, "differing": 0,
            "visibly_differing": 0, "largest_ulps": 0, "psnr_db": null}, "context_seconds": 0, "build_seconds": 0,
            "work": {"steps": 9, "de_calls": 9, "iterations": 9}, "operations": 10,
            "samples": [{"launch": 0, "round": 0, "kernel": 0.5, "wall": 0.6, "upload": 0, "readback": 0}]}]})",
                                     "file.json");
    const Row& row = read.rows.at(0);
    EXPECT_EQ(read.study, "simd-widths");
    EXPECT_EQ(row.name(), "mandelbox/float/fast/openmp/0/simd-width=16");
    EXPECT_EQ(row.verification.against, "openmp --simd-width 1");
    EXPECT_EQ(row.simd_width, 16);
    EXPECT_EQ(row.samples.at(0).host, 0.5) << "the kernel's time, measured by the host's clock";
    EXPECT_EQ(row.step_factor, 0);
    EXPECT_FALSE(row.operations_error);
    const Counted& counted = read.counts.at(0);
    EXPECT_EQ(counted.setting.without, "refinement");
    EXPECT_EQ(counted.all().divisions, 15U);
    ASSERT_EQ(counted.lane_use.size(), 1U) << "for one vector length only, without refill";
    EXPECT_EQ(counted.lane_use[0].together.in_iterations, 0.25);
    EXPECT_FALSE(counted.lane_use[0].refilled);
    EXPECT_FALSE(counted.errors);
}

// The share of peak has the same relative error as the number of operations.
TEST(ResultFile, TheShareOfThePeakHasTheOperationsError)
{
    Result result = parse_result(text_of(with_counts()), "file.json");
    result.peaks.push_back({"machine", "openmp", 0, Precision::f32, 1e12});
    const Json figures = json_of(derived(result))["rows"][0]["figures"];
    EXPECT_NEAR(figures["share_of_peak_standard_error"].get<double>(), 0.01 * figures["share_of_peak"].get<double>(),
                1e-12);
}

TEST(ResultFile, AnEmptyListOfLanesIsRefused)
{
    Json json = with_counts();
    json["counts"][0]["lane_use"] = Json::array();
    EXPECT_NE(refusal_of(text_of(json)).find("lane_use: [] given"), std::string::npos);
}

TEST(ResultFile, ADriversNameThatIsNoUtf8LosesNothing)
{
    Result result = made_result({made_row("openmp", seven)});
    result.rows[0].driver = "driver \xff 1";
    EXPECT_EQ(parse_result(text_of(json_of(result)), "file.json").rows[0].samples.size(), seven.size());
}

// Times of a row as printed in Google Benchmark's format: its repetitions, and its median.
struct Printed {
    std::vector<double> repetitions;
    double median = 0;
};

Printed printed_json(const Result& result)
{
    Printed printed;
    const Json json = Json::parse(to_google_benchmark(result, "json"));
    for (const Json& row : json["benchmarks"]) {
        if (row["run_type"] == "aggregate") {
            printed.median = row["real_time"];
        } else {
            printed.repetitions.push_back(row["real_time"]);
        }
    }
    return printed;
}

Printed printed_csv(const Result& result)
{
    Printed printed;
    std::istringstream lines(to_google_benchmark(result, "csv"));
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("\"mandel")) continue;
        // name,iterations,real_time
        const double time = std::stod(line.substr(line.find(',', line.find(',') + 1) + 1));
        if (line.find("_median\"") != std::string::npos) {
            printed.median = time;
        } else {
            printed.repetitions.push_back(time);
        }
    }
    return printed;
}

TEST(GoogleBenchmark, TheMedianRowIsTheMedianOfTheRepetitions)
{
    const Result result = made_result({made_row("openmp", seven)});
    for (const Printed& printed : {printed_json(result), printed_csv(result)}) {
        ASSERT_EQ(printed.repetitions.size(), seven.size());
        EXPECT_NEAR(printed.repetitions[3], 19, 1e-9) << "ms";
        EXPECT_NEAR(printed.median, median(printed.repetitions), 1e-9);
    }
}

TEST(GoogleBenchmark, AllRunesAreRepetitions)
{
    const Printed printed = printed_json(made_result({made_row("openmp", seven, 3)}, 3));
    EXPECT_EQ(printed.repetitions.size(), seven.size());
    EXPECT_NEAR(printed.median, 13, 1e-9);
}

TEST(GoogleBenchmark, CountersAreNotDividedByTheRepetitions)
{
    const Json json = Json::parse(to_google_benchmark(made_result({made_row("openmp", seven)}), "json"));
    const Json& aggregate = json["benchmarks"].back();
    EXPECT_NEAR(aggregate["wall"], 0.026, 1e-12);
    EXPECT_EQ(aggregate["name"], "mandelbox/float/exact/openmp/0/iterations:1/manual_time_median");
}

}  // namespace
}  // namespace mandelmarch::bench
