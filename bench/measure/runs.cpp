// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>

#include "bench/measure/interruption.h"
#include "bench/result/figures.h"
#include "bench/result/result_file.h"
#include "core/os/child_process.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

Result merged(std::vector<Result> results)
{
    Result all = std::move(results.front());
    for (std::size_t i = 1; i < results.size(); ++i) {
        Result& one = results[i];
        for (Row& row : one.rows) {
            const auto same = std::ranges::find_if(all.rows, [&](const Row& r) { return r.name() == row.name(); });
            if (same == all.rows.end()) {
                all.rows.push_back(std::move(row));
                continue;
            }
            same->samples.insert(same->samples.end(), row.samples.begin(), row.samples.end());
            if (same->failure.empty()) same->failure = row.failure;
            same->verification.passed =
                same->verification.passed && (row.verification.passed || !row.unavailable.empty());
        }
        raise_peaks(all.peaks, one.peaks);
        all.warnings.insert(all.warnings.end(), one.warnings.begin(), one.warnings.end());
    }
    all.runs += static_cast<int>(results.size()) - 1;
    return derived(std::move(all));
}

}  // namespace

Result with_further_runs(Result first, int count, const RunProcess& run)
{
    std::vector<Result> results{std::move(first)};
    std::vector<std::string> lost;
    const Interruption interruption;
    for (int number = results.front().runs; number < count && interrupted() == 0; ++number) {
        try {
            results.push_back(run(number));
            for (std::string& warning : results.back().warnings) warning = fmt::format("run {}: {}", number, warning);
        } catch (const std::exception& error) {
            lost.push_back(fmt::format("run {} {}", number, error.what()));
            say("bench: {}, the other runs are kept\n", printable(lost.back()));
        }
    }
    if (interrupted() != 0) lost.emplace_back("incomplete: the runs were interrupted");
    Result all = merged(std::move(results));
    all.warnings.insert(all.warnings.end(), lost.begin(), lost.end());
    return all;
}

Result run_again(const std::vector<std::string>& arguments, int run)
{
    const MemoryFile file;
    // Start this program again, under the name by which it was called.
    std::vector<std::string> words{program_invocation_name};
    words.insert(words.end(), arguments.begin(), arguments.end());
    words.insert(words.end(), {"--run", std::to_string(run)});
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    ChildProcess child({.words = std::move(words), .program = program, .output = file.number()});
    while (!child.ends_within(interrupted() != 0 ? ChildProcess::no_limit : 0.1)) {
        if (interrupted() != 0) child.interrupt();
    }
    const int code = child.end().code;
    // bench writes a result only if it ends with one of these exit codes. exit_failure means a wrong picture.
    if (code != exit_success && code != exit_failure && code != 128 + SIGINT)
        throw Error(fmt::format("ended with {}", code));
    const std::string text = file.text();
    if (text.empty()) throw Error(fmt::format("ended with {} and left no result", code));
    try {
        return parse_result(text, "its result");
    } catch (const InputError& error) {
        throw Error(fmt::format("ended with {} and left an incomplete result: {}", code, error.what()));
    }
}

}  // namespace mandelmarch::bench
