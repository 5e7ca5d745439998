// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <sstream>

#include "bench/print/printers.h"
#include "core/base/error.h"

namespace mandelmarch::bench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;

std::unique_ptr<benchmark::BenchmarkReporter> reporter_of(const std::string& format)
{
    if (format == "console") return std::make_unique<benchmark::ConsoleReporter>(benchmark::ConsoleReporter::OO_None);
    if (format == "json") return std::make_unique<benchmark::JSONReporter>();
    if (format == "csv") {
        // Google Benchmark deprecates its CSV reporter, but scripts still read that format.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
        return std::make_unique<benchmark::CSVReporter>();
#pragma GCC diagnostic pop
    }
    throw InputError(fmt::format("--benchmark_format: '{}' given, expected console, json or csv", format));
}

// Returns a sample as one of Google Benchmark's repetitions. Its real time and CPU time are both the kernel time.
Run run_of(const Row& row, const Sample& sample)
{
    Run run;
    run.run_name.function_name = row.name();
    run.run_name.iterations = "iterations:1";
    run.run_name.time_type = "manual_time";
    run.family_index = run.per_family_instance_index = run.repetition_index = 0;
    run.repetitions = static_cast<std::int64_t>(row.samples.size());
    run.time_unit = benchmark::kMillisecond;
    run.real_accumulated_time = run.cpu_accumulated_time = sample.kernel;
    run.counters["wall"] = sample.wall;
    run.counters["upload"] = sample.upload;
    run.counters["host"] = sample.host;
    run.counters["readback"] = sample.readback;
    run.statistics = nullptr;
    return run;
}

// Returns the medians of a configuration's repetitions, like Google Benchmark's aggregates. As in Google Benchmark, an
// aggregate has as many iterations as there are repetitions. The reporters divide times, but not counters, by the
// number of iterations, so the median time is multiplied by this number.
Run median_of(const Row& row)
{
    const Figures& f = *row.figures;
    Run run = run_of(row, {.kernel = f.kernel.median * static_cast<double>(row.samples.size()),
                           .wall = f.wall.median,
                           .upload = f.upload,
                           .readback = f.readback,
                           .host = f.host});
    run.run_type = Run::RT_Aggregate;
    run.aggregate_name = "median";
    run.iterations = static_cast<benchmark::IterationCount>(row.samples.size());
    return run;
}

}  // namespace

std::string to_google_benchmark(const Result& result, const std::string& format)
{
    const auto reporter = reporter_of(format);
    std::ostringstream out;
    reporter->SetOutputStream(&out);
    reporter->SetErrorStream(&out);
    benchmark::BenchmarkReporter::Context context;
    std::size_t longest = 10;
    for (const Row& row : result.rows) longest = std::max(longest, row.name().size());
    context.name_field_width = longest + std::string("/iterations:1/manual_time_median").size();
    if (!reporter->ReportContext(context)) return out.str();
    std::int64_t family = 0;
    for (const Row& row : result.rows) {
        if (!row.timed()) continue;
        std::vector<Run> runs;
        for (const Sample& sample : row.samples) {
            runs.push_back(run_of(row, sample));
            runs.back().family_index = family;
            runs.back().repetition_index = static_cast<std::int64_t>(runs.size()) - 1;
        }
        reporter->ReportRuns(runs);
        Run aggregate = median_of(row);
        aggregate.family_index = family++;
        reporter->ReportRuns({aggregate});
    }
    reporter->Finalize();
    return out.str();
}

}  // namespace mandelmarch::bench
