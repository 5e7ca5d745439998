// SPDX-License-Identifier: Apache-2.0
// Commands on stored results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <set>

#include "bench/command/commands.h"
#include "bench/result/compare.h"
#include "bench/result/differences.h"
#include "bench/command/outputs.h"
#include "bench/result/portability.h"
#include "bench/result/result_file.h"
#include "bench/print/printers.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

std::vector<Result> results_in(const std::vector<std::string>& files)
{
    std::vector<Result> results;
    for (const std::string& file : files) {
        if (auto result = read_if_result(file)) {
            results.push_back(std::move(*result));
        } else {
            say("bench: {}: no result of bench, left out\n", printable(file));
        }
    }
    if (results.empty())
        throw InputError("bench portability: no result of bench among the files, expected one at least");
    std::set<std::string> revisions;
    for (const Result& result : results) {
        const Json revision = value_at(result.environment, "/git/revision");
        revisions.insert(revision.is_string() ? printable(revision.get<std::string>().substr(0, 8), 8) : "unknown");
    }
    if (revisions.size() > 1)
        say("bench: warning: these results are of different revisions: {}\n", fmt::join(revisions, ", "));
    return results;
}

}  // namespace

Run with_file(CLI::App& app, std::string (*text)(const std::string& path))
{
    const auto path = std::make_shared<std::string>();
    app.add_option("FILE", *path, "result file written by --json")->required();
    return [path, text]() -> int {
        print(std::string_view(text(*path)));
        return exit_success;
    };
}

Run csv_command(CLI::App& app, Registry& /*registry*/)
{
    return with_file(app, [](const std::string& path) { return to_csv(read_result(path)); });
}

Run compare_command(CLI::App& app, Registry& /*registry*/)
{
    const auto files = std::make_shared<std::vector<std::string>>();
    app.add_option("FILES", *files, "two result files written by --json")
        ->expected(2)
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
        ->required();
    return [files]() -> int {
        const ComparedResults comparison = compare_results(read_result(files->at(0)), read_result(files->at(1)));
        print(std::string_view(to_console(comparison)));
        return regression(comparison.rows) ? exit_failure : exit_success;
    };
}

Run portability_command(CLI::App& app, Registry& /*registry*/)
{
    struct State {
        std::vector<std::string> paths;
        std::vector<Portability> found;
        Outputs outputs;
    };
    const auto state = std::make_shared<State>();
    app.add_option("FILES", state->paths, "result files written by --json, or folders of them")
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
        ->required();
    state->outputs.option(app, "--json",
                          "write the metric and the data of cascade plots as JSON to this file (-: standard output)",
                          [s = state.get()] { return text_of(json_of(s->found)); });
    state->outputs.option(app, "--csv",
                          "write pixels per second on each platform, for p3-analysis-library (-: standard output)",
                          [s = state.get()] { return to_csv(s->found); });
    return [state] {
        const std::vector<std::string> files = result_files(state->paths);
        return state->outputs.deliver(files, [&]() -> Outputs::Done {
            state->found = portability(results_in(files));
            return {to_console(state->found)};
        });
    };
}

}  // namespace mandelmarch::bench
