// SPDX-License-Identifier: Apache-2.0
#include "bench/session.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/environment.h"
#include "bench/figures.h"
#include "bench/profile.h"
#include "bench/proof.h"
#include "bench/runner.h"
#include "bench/steadiness.h"
#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/stopwatch.h"
#include "core/scene/fractal.h"

namespace mandelmarch::bench {
namespace {

// Seconds that the timed rounds may take: what is left of two and a half minutes for everything, but not too little and
// not too much.
constexpr double whole_budget = 150;
constexpr double least_budget = 15;
constexpr double usual_budget = 100;

// What the proof of one row needs: its picture with values and that of its yardstick, and one more for the timing.
void check_memory(const Scene& scene)
{
    const std::uint64_t pixels = static_cast<std::uint64_t>(scene.width) * static_cast<std::uint64_t>(scene.height);
    const std::uint64_t needed =
        pixels * (3 * Image::bytes_per_pixel(Image::Layers::all) + Image::bytes_per_pixel(Image::Layers::bytes));
    if (const std::uint64_t available = available_memory(); needed > available) {
        throw Unavailable(fmt::format("{} x {} pixels need {} MiB of memory and {} MiB are available", scene.width,
                                      scene.height, needed >> 20, available >> 20));
    }
}

void describe(Row& row, const RenderReport& report)
{
    row.threads = report.threads;
    row.pack = report.pack;
    row.instruction_set = report.instruction_set;
    row.context = report.timings.context;
    row.build = report.timings.build;
    row.stride = report.stride;
    row.unsettled = report.unsettled;
    row.work = report.work;
}

Sample first_sample(const RenderReport& report, int launch)
{
    const Timings& t = report.timings;
    return {
        .launch = launch, .round = 0, .kernel = t.kernel, .wall = t.wall, .upload = t.upload, .readback = t.readback};
}

// Draws the row's picture once and compares it. What comes back can be timed.
std::optional<Live> proven(Case& one, Yardsticks& yardsticks, const Rules& rules)
{
    Row& row = one.row;
    Live live;
    live.one = &one;
    RenderReport report;
    try {
        check_memory(one.scene);
        const auto& yardstick = yardsticks.for_case(one);
        live.renderer = one.backend->create(one.options);
        if (yardsticks.is_yardstick(one)) {
            report = yardstick.report;
            row.proof.drawn = row.proof.fine = row.proof.yardstick = true;
            row.proof.text = row.proof.level = "yardstick";
            live.fingerprint = fingerprint(yardstick.image);
        } else {
            Image image(one.scene.width, one.scene.height, Image::Layers::all);
            report = live.renderer->render(one.scene, image);
            prove(row, one.backend->facts().role, image, yardstick);
            live.fingerprint = fingerprint(image);
        }
        describe(row, report);
    } catch (const Unavailable& error) {
        row.unavailable = error.what();
    } catch (const InputError& error) {
        // A pack width that this machine does not have, say.
        row.unavailable = error.what();
    } catch (const Error& error) {
        row.failure = error.what();
    }
    if (!row.proof.fine || !row.unavailable.empty()) return std::nullopt;
    live.expected = report.timings.kernel;
    if (!rules.repetitions && live.expected > rules.long_picture) {
        row.samples.push_back(first_sample(report, rules.launch));
        live.done = true;
    }
    return live;
}

bool same_text(const Counted& counted, const Row& row)
{
    return counted.fractal == row.fractal && counted.precision == row.precision && counted.mode == row.mode &&
           same_picture(counted.setting, row.setting) && counted.setting.without == row.setting.without;
}

// Counts each picture once, and gives every row that draws it its operations.
void count_all(std::vector<Live>& rows, Result& result, const Phase& phase)
{
    std::size_t done = 0;
    for (Live& live : rows) {
        phase("counting operations", static_cast<double>(done++) / static_cast<double>(rows.size()));
        Row& row = live.one->row;
        // The reference shares no formula with the text: what the text does says nothing of it.
        if (live.one->backend->facts().role == Role::reference) continue;
        auto found = std::ranges::find_if(result.counts, [&](const Counted& c) { return same_text(c, row); });
        if (found == result.counts.end()) {
            Counted counted{.fractal = row.fractal,
                            .precision = row.precision,
                            .mode = row.mode,
                            .setting = row.setting,
                            .count = count_operations(live.one->scene, {.precision = row.precision,
                                                                        .mode = row.mode,
                                                                        .techniques = live.one->options.techniques})};
            found = result.counts.insert(result.counts.end(), std::move(counted));
        }
        row.operations = found->count.per_iteration() * static_cast<double>(row.work.iterations);
    }
}

}  // namespace

std::vector<Peak> measure_peaks(const Registry& registry, const Options& options, const Phase& phase)
{
    std::vector<Peak> peaks;
    for (const auto& backend : registry.backends()) {
        // Any backend may reach the most of a device: all are asked, whichever rows are timed.
        int index = 0;
        for (const Device& device : listing_of(*backend).devices) {
            for (const Precision precision : precisions_of(options)) {
                phase(fmt::format("multiply-add peak, {} {}", backend->name(), name_of(precision)), 0);
                try {
                    const auto rate = backend->multiply_add_peak({.device = index, .precision = precision});
                    if (rate) {
                        peaks.push_back({platform_of(device), std::string(backend->name()), index, precision, *rate});
                    }
                } catch (const Error&) {
                    continue;  // no double, say; a device that fails has said so in its rows
                }
            }
            ++index;
        }
    }
    return peaks;
}

Result measure(const Registry& registry, const Options& options, const Phase& phase)
{
    Result result;
    result.study = study_named(options.study).name;
    result.seed = options.seed;
    Steadiness steadiness;
    result.environment = environment(registry);
    std::vector<Case> cases = cases_of(registry, options);
    if (cases.empty()) throw InputError("bench: no row is left by these options (bench --list shows the rows)");
    for (const Case& one : cases) {
        if (one.backend != nullptr || one.row.backend != options.backend) continue;
        if (!one.row.failure.empty()) throw Error(one.row.failure);
        throw Unavailable(fmt::format("backend {}: {}", options.backend, one.row.unavailable));
    }

    const auto start = Clock::now();
    Rules rules{.repetitions = options.repetitions, .seed = options.seed, .launch = options.launch};
    Yardsticks yardsticks(registry);
    std::vector<Live> live;
    // In the order of the yardsticks, so that each is drawn once.
    std::vector<Case*> order;
    for (Case& one : cases) {
        if (one.backend != nullptr) order.push_back(&one);
    }
    std::ranges::stable_sort(order, {}, [&](const Case* one) { return yardsticks.key(*one); });
    for (std::size_t i = 0; i < order.size(); ++i) {
        phase("proof", static_cast<double>(i) / static_cast<double>(order.size()));
        if (auto row = proven(*order[i], yardsticks, rules)) live.push_back(std::move(*row));
    }
    count_all(live, result, phase);
    if (options.study == "profile") result.stages = profile(registry, options, phase);
    raise_peaks(result.peaks, measure_peaks(registry, options, phase));
    const double spent = seconds_since(start);
    rules.budget = options.budget.value_or(std::clamp(whole_budget - spent, least_budget, usual_budget));
    run_rounds(live, rules, [&](double share) { phase("timing", share); });
    // Once more: a machine that was slow before must not make the shares look better.
    raise_peaks(result.peaks, measure_peaks(registry, options, phase));
    for (Case& one : cases) result.rows.push_back(std::move(one.row));
    for (std::string& warning : steadiness.warnings(result)) result.warnings.push_back(std::move(warning));
    result.environment["during"] = steadiness.during();
    return result;
}

}  // namespace mandelmarch::bench
