#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "bench/report.h"
#include "bench/statistics.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

std::unique_ptr<benchmark::BenchmarkReporter> reporter_of(const std::string& format)
{
    if (format == "console") return std::make_unique<benchmark::ConsoleReporter>(benchmark::ConsoleReporter::OO_None);
    if (format == "json") return std::make_unique<benchmark::JSONReporter>();
    if (format == "csv") {
        // Google Benchmark calls it deprecated and keeps it; its users' scripts read it.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
        return std::make_unique<benchmark::CSVReporter>();
#pragma GCC diagnostic pop
    }
    throw InputError(fmt::format("--benchmark_format: '{}' given, expected console, json or csv", format));
}

// One aggregate of a row's runs, as Google Benchmark names them.
Run median_of(const std::vector<Run>& runs)
{
    Run made = runs.front();
    made.run_type = Run::RT_Aggregate;
    made.aggregate_name = "median";
    made.repetition_index = 0;
    made.iterations = static_cast<benchmark::IterationCount>(runs.size());
    const auto middle = [&](auto value) {
        std::vector<double> values;
        values.reserve(runs.size());
        for (const Run& run : runs) values.push_back(value(run));
        return median(std::move(values));
    };
    // Of an aggregate's time the reporters take seconds; they multiply by the unit themselves.
    made.real_accumulated_time = middle([](const Run& run) { return run.real_accumulated_time; });
    made.cpu_accumulated_time = middle([](const Run& run) { return run.cpu_accumulated_time; });
    for (auto& counter : made.counters) {
        counter.second.value = middle([&](const Run& run) { return run.counters.at(counter.first).value; });
    }
    return made;
}

}  // namespace

// The runs were made one repetition at a time; here they become the repetitions of one benchmark. compare.py pairs them
// by their names.
std::string to_google_benchmark(const Result& result, const Runs& runs, const std::string& format)
{
    const auto reporter = reporter_of(format);
    std::ostringstream out;
    reporter->SetOutputStream(&out);
    reporter->SetErrorStream(&out);
    benchmark::BenchmarkReporter::Context context;
    std::size_t longest = 10;
    for (const auto& [name, of_row] : runs) longest = std::max(longest, name.size());
    context.name_field_width = longest + std::string("/iterations:1/manual_time_median").size();
    if (!reporter->ReportContext(context)) return out.str();
    for (const Row& row : result.rows) {
        const auto found = runs.find(row.name());
        if (found == runs.end() || !row.timed()) continue;
        std::vector<Run> repetitions = found->second;
        for (std::size_t i = 0; i < repetitions.size(); ++i) {
            repetitions[i].repetitions = static_cast<std::int64_t>(repetitions.size());
            repetitions[i].repetition_index = static_cast<std::int64_t>(i);
        }
        reporter->ReportRuns(repetitions);
        reporter->ReportRuns({median_of(repetitions)});
    }
    reporter->Finalize();
    return out.str();
}

}  // namespace mandelmarch::bench
