// SPDX-License-Identifier: Apache-2.0
// Tests of results: values that are read or rejected, derived quantities, and results of several runs.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/measure/runs.h"
#include "bench/print/printers.h"
#include "bench/result/result_file.h"
#include "core/text/error.h"
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

// Ratios are computed round by round. Therefore the slow third round does not change them. The reference has no ratio,
// because it does not run the kernel.
TEST(ResultFile, OtherBackendsAreComparedWithTheHost)
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
TEST(ResultFile, ScalarKernelIsAnApplication)
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

// Ratios are computed round by round. Therefore the slow round does not change them. One row of the sweep has another
// aspect ratio, and is left out of the comparisons with the previous value. The last row has no sweep value, and does
// not belong to the sweep.
TEST(ResultFile, PointsOfASweepAreComparedWithTheFirstAndThePrevious)
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

// Each rung is compared with the rung before, although the two differ in backend, precision or mode. Negative control:
// in any other study, such rows are not compared.
TEST(ResultFile, RungsOfALadderAreComparedWithTheOneBefore)
{
    std::vector<Row> rows{made_row("reference", {12, 12, 12, 12, 12, 12}), made_row("openmp", {6, 6, 6, 6, 6, 6}),
                          made_row("openmp", {2, 2, 2, 2, 2, 2})};
    for (std::size_t i = 0; i < rows.size(); ++i) rows[i].sweep_value = "rung=" + std::to_string(i);
    rows[0].precision = Precision::f64;
    rows[2].mode = Mode::fast;
    Result result = made_result(std::move(rows));
    EXPECT_TRUE(result.questions.to_previous_value.empty());
    result.study = ladder_study;
    result = derived(std::move(result));
    const auto& previous = result.questions.to_previous_value;
    ASSERT_EQ(previous.size(), 2U);
    EXPECT_DOUBLE_EQ(previous[0].ratio.median, 1.0 / 2);
    EXPECT_DOUBLE_EQ(previous[1].ratio.median, 1.0 / 3);
    const std::string text = to_console(result, false);
    EXPECT_NE(text.find("mandelbox all together       6.000 [6.000, 6.000]"), std::string::npos) << text;
}

// Each of these values is an error, with one line that has the file, the place and the value.
TEST(ResultFile, ImpossibleValuesAreRefused)
{
    const std::vector<std::pair<std::string, std::string>> changes{
        {"/rows/0/setting/width", "-5"},
        {"/rows/0/setting/frames", "0.5"},
        {"/rows/0/samples/3/kernel", "null"},
        {"/rows/0/samples/3/wall", "1e300"},
        {"/rows/0/samples/3", "[]"},
        {"/rows/0/samples", "{}"},
        {"/rows/0/verification/passed", "1"},
        {"/rows/0/verification/pixels", "18446744073709551615"},
        {"/rows/0/precision", "\"half\""},
        {"/rows/0/backend", "null"},
        {"/runs", "true"},
        {"/warnings", "[1]"},
        {"/environment", "[]"},
        {"/version", "3"}};
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

Json with_counts()
{
    Result result = made_result({made_row("openmp", seven)});
    Counted counted;
    counted.fractal = "mandelbox";
    counted.setting.width = counted.setting.height = 100;
    counted.lane_use = {{16, {0.5, 0.25}, ActiveLanes{0.75, 0.5}}};
    result.rows[0].operations = 1e9;
    result.counts.push_back(counted);
    return json_of(derived(result));
}

// A file holds facts alone, and all samples of a row in one line. Its figures are those of its samples, whatever else
// stands in the file.
TEST(ResultFile, FiguresAreComputedFromTheFacts)
{
    const Json json = with_counts();
    Json facts = facts_of(parse_result(text_of(json), "file.json"));
    EXPECT_FALSE(facts["rows"][0].contains("figures"));
    EXPECT_FALSE(facts.contains("winners"));
    const std::string text = text_of(facts);
    EXPECT_EQ(json_of(parse_result(text, "file.json")), json);
    const std::string line = text.substr(text.find("\"samples\""));
    EXPECT_NE(line.substr(0, line.find('\n')).find("\"round\": 6"), std::string::npos) << line;
    facts["rows"][0]["figures"]["kernel_seconds"]["median"] = 1;
    facts["rows"][0]["later"] = "unknown to this build";
    EXPECT_EQ(json_of(parse_result(text_of(facts), "file.json")), json);
}

TEST(ResultFile, MissingValuesAreUnknown)
{
    Json facts = facts_of(parse_result(text_of(with_counts()), "file.json"));
    for (const char* key : {"driver", "step_factor"}) facts["rows"][0].erase(key);
    facts["counts"][0]["lane_use"][0].erase("refilled");
    facts.erase("warnings");
    const Json json = json_of(parse_result(text_of(facts), "file.json"));
    EXPECT_EQ(json["rows"][0]["driver"], "");
    EXPECT_TRUE(json["rows"][0]["step_factor"].is_null());
    EXPECT_TRUE(json["counts"][0]["lane_use"][0]["refilled"].is_null());
    EXPECT_TRUE(json["warnings"].empty());
}

TEST(ResultFile, DamagedFilesAreRefused)
{
    const std::string deep = "{\"version\": " + std::string(1'000'000, '[');
    EXPECT_NE(refusal_of(deep).find("nested"), std::string::npos) << "before it is parsed";
    Json lacking = whole();
    lacking["rows"][0].erase("samples");
    EXPECT_NE(refusal_of(text_of(lacking)).find("rows[0]: 'samples' is missing"), std::string::npos);
    EXPECT_NE(refusal_of("[]"), "");
    Json twice = whole();
    twice["rows"].push_back(twice["rows"][0]);
    EXPECT_NE(refusal_of(text_of(twice)).find("mandelbox/float/exact/openmp/0 is there twice"), std::string::npos);
    Json endless = whole();
    endless["version"] = std::string(5'000'000, 'x');
    EXPECT_LT(refusal_of(text_of(endless)).size(), 300U) << "a long text is truncated";
    Json idle = with_counts();
    idle["counts"][0]["lane_use"] = Json::array();
    EXPECT_NE(refusal_of(text_of(idle)).find("lane_use: [] given"), std::string::npos);
}

TEST(ResultFile, NameThatIsNotUtf8LosesNothing)
{
    Result result = made_result({made_row("openmp", seven)});
    result.rows[0].driver = "driver \xff 1";
    EXPECT_EQ(parse_result(text_of(json_of(result)), "file.json").rows[0].samples.size(), seven.size());
}

// Returns a row in whose samples the fraction `share` of the wall time belongs to none of the measured parts.
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

// If a sample consists of several pictures (`frames`), its wall time also includes opening the device and building
// kernels, for which the sample has no parts. Therefore nothing is reported for such a row.
TEST(Parts, AreReportedIfTheyLeaveMuchOfTheWallTime)
{
    Row row = leaving(0.25);
    EXPECT_NEAR(made_result({row}).rows[0].figures->unaccounted.value(), 0.25, 1e-12);
    EXPECT_TRUE(is_named(leaving(0.06)));
    EXPECT_FALSE(is_named(leaving(0.04)));
    row.setting.frames = 10;
    EXPECT_FALSE(made_result({row}).rows[0].figures->unaccounted.has_value());
    EXPECT_FALSE(is_named(row));
}

Result of_run(int run)
{
    Result result = made_result({made_row("openmp", {0.1, 0.2}), made_row("opencl", {0.3, 0.4})});
    for (Row& row : result.rows) {
        for (Sample& sample : row.samples) sample.run = run;
    }
    result.peaks.push_back({"machine", "openmp", 0, Precision::f64, 100.0 + run});
    result.warnings.emplace_back("noise");
    return result;
}

TEST(Runs, AreMergedByRow)
{
    const Result all = with_further_runs(of_run(0), 3, [](int run) {
        Result result = of_run(run);
        if (run == 1) result.rows[1].failure = "died";
        return result;
    });
    EXPECT_EQ(all.runs, 3);
    EXPECT_EQ(all.warnings, (std::vector<std::string>{"noise", "run 1: noise", "run 2: noise"}));
    EXPECT_EQ(run_medians(all.rows[0]).size(), 3U);
    EXPECT_EQ(all.rows[0].samples.size(), 6U);
    ASSERT_EQ(all.peaks.size(), 1U);
    EXPECT_EQ(all.peaks[0].rate, 102);
    EXPECT_TRUE(all.rows[1].failed());
    EXPECT_FALSE(all.rows[1].timed());
}

}  // namespace
}  // namespace mandelmarch::bench
