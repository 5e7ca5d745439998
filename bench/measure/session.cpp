// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/session.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/measure/environment.h"
#include "bench/measure/interruption.h"
#include "bench/measure/moving_eye.h"
#include "bench/measure/peaks.h"
#include "bench/measure/steadiness.h"
#include "bench/measure/telemetry.h"
#include "bench/measure/verify.h"
#include "bench/result/figures.h"
#include "core/os/stopwatch.h"
#include "core/text/environment.h"
#include "core/text/error.h"

namespace mandelmarch::bench {
namespace {

// Seconds. The timed rounds get the part of whole_budget that verification, counting and the first peaks have not used,
// but at least least_budget and at most usual_budget.
constexpr double whole_budget = 150;
constexpr double least_budget = 15;
constexpr double usual_budget = 100;

// Counts the operations of each picture once, and stores their number in all configurations that render this picture.
void count_all(std::vector<TimedCase>& rows, Result& result, const Phase& phase)
{
    std::size_t done = 0;
    for (TimedCase& live : rows) {
        phase({"counting operations", static_cast<double>(done++) / static_cast<double>(rows.size())});
        Row& row = live.one->row;
        // The reference is left out: it is a separate implementation, with other operations.
        if (live.one->backend->info().role == Role::reference) continue;
        auto found = std::ranges::find_if(result.counts, [&](const Counted& c) { return is_counted_for(c, row); });
        if (found == result.counts.end()) {
            Counted counted{count_operations(live.one->scene, {.precision = row.precision,
                                                               .mode = row.mode,
                                                               .techniques = live.one->options.techniques}),
                            row.fractal, row.precision, row.mode, row.setting};
            found = result.counts.insert(result.counts.end(), std::move(counted));
        }
        row.operations = found->per_iteration() * static_cast<double>(row.work.iterations);
    }
}

}  // namespace

Result measure(const Registry& registry, const Options& options, const Phase& phase)
{
    Result result;
    result.study = options.study->name;
    result.seed = options.seed;
    Steadiness steadiness;
    result.environment = environment(registry);
    std::vector<Case> cases = cases_of(registry, options);
    if (cases.empty()) throw InputError("bench: these options select no configuration (bench --list shows all)");
    for (const Case& one : cases) {
        if (one.backend != nullptr || options.backends != std::vector{one.row.backend}) continue;
        if (!one.row.failure.empty()) throw Error(one.row.failure);
        throw Unavailable(fmt::format("backend {}: {}", one.row.backend, one.row.unavailable));
    }

    const auto start = Clock::now();
    std::vector<TimedCase> live = verified_cases(cases, registry, phase);
    keep_long_pictures(live, options);
    if (options.study->counts) count_all(live, result, phase);
    const PeakMeasurement peaks = [&](const auto& wanted) {
        const bool measured = options.peaks && options.study->peaks;
        return measured ? measure_peaks(registry, options, phase, wanted) : std::vector<Peak>();
    };
    std::vector<Peak> measured = peaks(every_peak);
    const double spent = seconds_since(start);
    Options limited = options;
    limited.budget = options.budget.value_or(std::clamp(whole_budget - spent, least_budget, usual_budget));
    const bool replays = std::ranges::any_of(live, [](const TimedCase& c) { return c.one->backend->info().replays; });
    MovingEye eye(registry);
    result.moved_eye = options.move_eye || replays;
    const Interruption interruption;
    run_rounds(live, limited, phase, result.moved_eye ? &eye : nullptr);
    const nlohmann::ordered_json gpus = Telemetry().gpus();
    // Measure the peaks again. If the machine was slower before the rounds, the first peaks are too low, and the shares
    // of peak would be too high.
    if (interrupted() == 0) {
        for (const Peak& peak : peaks(every_peak)) measured.push_back(peak);
        measured = settled_peaks(std::move(measured), peaks);
    }
    raise_peaks(result.peaks, measured);
    for (Case& one : cases) result.rows.push_back(std::move(one.row));
    result.warnings = peak_warnings(measured);
    for (const std::string& warning : eye.warnings()) result.warnings.push_back(warning);
    if (!environment_variable("MANDELMARCH_REHEARSAL").empty()) {  // packaging/gpu_check
        result.warnings.emplace(result.warnings.begin(), "a rehearsal: a device called a GPU may not be one");
    }
    if (interrupted() != 0) result.warnings.emplace_back("incomplete: the rounds were interrupted");
    for (std::string& warning : steadiness.warnings(result)) result.warnings.push_back(std::move(warning));
    result.environment["during"] = steadiness.during();
    result.environment["telemetry"]["gpus"] = gpus;
    return derived(std::move(result));
}

}  // namespace mandelmarch::bench
