// SPDX-License-Identifier: Apache-2.0
// Commands on stored results.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "bench/command/commands.h"
#include "bench/command/outputs.h"
#include "bench/print/printers.h"
#include "bench/result/compare.h"
#include "bench/result/differences.h"
#include "bench/result/portability.h"
#include "bench/result/result_file.h"
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
        const nlohmann::ordered_json revision = value_at(result.environment, "/git/revision");
        revisions.insert(revision.is_string() ? printable(revision.get<std::string>().substr(0, 8), 8) : "unknown");
    }
    if (revisions.size() > 1)
        say("bench: warning: these results are of different revisions: {}\n", fmt::join(revisions, ", "));
    return results;
}

}  // namespace

std::string stored_csv(const std::string& path) { return to_csv(read_result(path)); }

void PrintCommand::declare(CLI::App& app, Registry& /*registry*/) { app.add_option(name, argument, about)->required(); }

int PrintCommand::run(Registry& /*registry*/) const
{
    print(std::string_view(text(argument)));
    return exit_success;
}

void CompareCommand::declare(CLI::App& app, Registry& /*registry*/)
{
    app.add_option("FILES", files, "two result files written by --json")
        ->expected(2)
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
        ->required();
}

int CompareCommand::run(Registry& /*registry*/) const
{
    const Result old = read_result(files.at(0));
    const ComparedResults comparison = compare_results(old, read_result(files.at(1)));
    print(std::string_view(to_console(comparison)));
    return regression(comparison.rows) ? exit_failure : exit_success;
}

void PortabilityCommand::declare(CLI::App& app, Registry& /*registry*/)
{
    app.add_option("FILES", paths, "result files written by --json, or folders of them")
        ->multi_option_policy(CLI::MultiOptionPolicy::Throw)
        ->required();
    outputs.declare(app, "--json", "the metric and the data of cascade plots as JSON");
    outputs.declare(app, "--csv", "pixels per second on each platform, for p3-analysis-library,");
}

int PortabilityCommand::run(Registry& /*registry*/) const
{
    const std::vector<std::string> files = result_files(paths);
    return outputs.deliver(files, [&]() -> Texts {
        const std::vector<Portability> found = portability(results_in(files));
        return {.table = to_console(found), .files = {{"--json", text_of(json_of(found))}, {"--csv", to_csv(found)}}};
    });
}

}  // namespace mandelmarch::bench
