// SPDX-License-Identifier: Apache-2.0
#include "bench/result/figures.h"

#include <algorithm>
#include <map>

namespace mandelmarch::bench {
namespace {

template <class Member>
std::vector<double> times(const Row& row, Member member)
{
    std::vector<double> values;
    for (const Sample& sample : row.samples) values.push_back(sample.*member);
    return values;
}

template <class Member>
ValuesByRun times_by_run(const Row& row, Member member)
{
    ValuesByRun runs;
    for (const Sample& sample : row.samples) runs[sample.run].push_back(sample.*member);
    return runs;
}

// Returns true if both configurations render the same picture with the same threads, frames and optimisations.
bool same_text(const Row& a, const Row& b)
{
    return a.setting.picture() == b.setting.picture() && a.fractal == b.fractal && a.precision == b.precision &&
           a.mode == b.mode && a.setting.threads == b.setting.threads && a.setting.frames == b.setting.frames &&
           a.setting.without == b.setting.without;
}

bool same_device(const Row& a, const Row& b) { return a.backend == b.backend && a.device == b.device; }

Ratio ratio_of(const Row& numerator, const Row& denominator)
{
    return {numerator.name(), denominator.name(), summary(ratios_by_run(numerator, denominator))};
}

// Returns the kernel times' ratios of all pairs of timed configurations that have the same mode and sweep value, and
// for which other_of(numerator, denominator) is true.
template <class Same>
std::vector<Ratio> ratios(const Result& result, Same other_of)
{
    std::vector<Ratio> found;
    for (const Row& denominator : result.rows) {
        if (!denominator.timed()) continue;
        for (const Row& numerator : result.rows) {
            if (!numerator.timed() || !other_of(numerator, denominator)) continue;
            if (numerator.mode != denominator.mode || numerator.sweep_value != denominator.sweep_value) continue;
            found.push_back(ratio_of(numerator, denominator));
        }
    }
    return found;
}

std::string_view swept(const Row& row)
{
    return std::string_view(row.sweep_value).substr(0, row.sweep_value.find('='));
}

bool same_sweep(const Result& result, const Row& a, const Row& b)
{
    if (a.fractal != b.fractal || a.sweep_value.empty() || swept(a) != swept(b)) return false;
    return result.study == ladder_study || (same_device(a, b) && a.precision == b.precision && a.mode == b.mode);
}

bool same_shape(const Row& a, const Row& b)
{
    return std::int64_t{a.setting.width} * b.setting.height == std::int64_t{b.setting.width} * a.setting.height;
}

std::vector<double> unaccounted_shares(const Row& row)
{
    std::vector<double> shares;
    for (const Sample& s : row.samples) shares.push_back(1 - (s.upload + s.host + s.readback) / s.wall);
    return shares;
}

// Returns the mean energy of a picture. Not the median, because counters of GPUs change only now and then.
std::optional<double> mean_joules(const Row& row)
{
    double sum = 0;
    int count = 0;
    for (const Sample& sample : row.samples) {
        sum += sample.joules.value_or(0);
        count += sample.joules ? 1 : 0;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace

bool is_counted_for(const Counted& counted, const Row& row)
{
    return counted.fractal == row.fractal && counted.precision == row.precision && counted.mode == row.mode &&
           counted.setting.picture() == row.setting.picture() && counted.setting.without == row.setting.without;
}

bool is_scalar(const Result& result, const Row& row)
{
    return row.setting.simd_width == 1 && row.backend == result.host();
}

std::vector<double> kernel_times(const Row& row) { return times(row, &Sample::kernel); }

ValuesByRun kernel_runs(const Row& row) { return times_by_run(row, &Sample::kernel); }

ValuesByRun wall_runs(const Row& row) { return times_by_run(row, &Sample::wall); }

std::vector<double> run_medians(const Row& row) { return medians_of(kernel_runs(row)); }

const Peak* peak_of(const Result& result, const std::string& platform, Precision precision)
{
    const Peak* best = nullptr;
    for (const Peak& peak : result.peaks) {
        if (peak.platform != platform || peak.precision != precision) continue;
        if (best == nullptr || peak.rate > best->rate) best = &peak;
    }
    return best;
}

ValuesByRun ratios_by_run(const Row& numerator, const Row& denominator)
{
    std::map<std::pair<int, int>, double> by_round;
    for (const Sample& s : denominator.samples) by_round[{s.run, s.round}] = s.kernel;
    ValuesByRun pairs;
    for (const Sample& s : numerator.samples) {
        const auto pair = by_round.find({s.run, s.round});
        if (pair != by_round.end() && pair->second > 0) pairs[s.run].push_back(s.kernel / pair->second);
    }
    return pairs;
}

namespace {

Figures figures_of(const Result& result, const Row& row)
{
    Figures f;
    f.kernel = summary(kernel_runs(row));
    f.wall = summary(wall_runs(row));
    f.upload = median(times(row, &Sample::upload));
    f.readback = median(times(row, &Sample::readback));
    f.host = median(times(row, &Sample::host));
    f.trial = median(times(row, &Sample::trial));
    if (row.setting.frames == 0 && f.wall.median > 0) f.unaccounted = median(unaccounted_shares(row));
    f.joules = mean_joules(row);
    const double seconds = f.kernel.median - f.trial;
    if (seconds > 0) {
        f.pixel_rate = static_cast<double>(row.setting.width) * row.setting.height / seconds;
        f.estimate_rate = static_cast<double>(row.work.de_calls) / seconds;
        f.iteration_rate = static_cast<double>(row.work.iterations) / seconds;
        if (row.operations > 0) f.operation_rate = row.operations / seconds;
    }
    if (const Peak* peak = peak_of(result, row.platform, row.precision); peak != nullptr && peak->rate > 0) {
        f.peak = peak->rate;
        if (row.operations > 0) f.bound = row.operations / peak->rate;
        if (f.operation_rate) f.share = *f.operation_rate / peak->rate;
    }
    const std::string reference = result.reference();
    for (const Row& other : result.rows) {
        if (&other != &row && other.timed() && same_text(other, row) && is_scalar(result, other) && f.wall.median > 0) {
            f.over_scalar = quotient(wall_runs(other), wall_runs(row));
        }
        if (other.setting.picture() == row.setting.picture() && other.fractal == row.fractal &&
            other.backend == reference && other.mode == Mode::exact && other.timed() && f.wall.median > 0) {
            // The reference's speed-up over itself is exactly 1.
            f.speed_up = &other == &row ? Quotient{} : quotient(wall_runs(other), wall_runs(row));
        }
    }
    return f;
}

Questions questions_of(const Result& result)
{
    const std::string host = result.host(), reference = result.reference();
    Questions found{.box_to_bulb = ratios(result,
                                          [](const Row& a, const Row& b) {
                                              return same_device(a, b) && a.fractal == box && b.fractal == bulb &&
                                                     a.precision == b.precision;
                                          }),
                    .double_to_float = ratios(result,
                                              [](const Row& a, const Row& b) {
                                                  return same_device(a, b) && a.fractal == b.fractal &&
                                                         a.precision == Precision::f64 && b.precision == Precision::f32;
                                              }),
                    .others_to_host = ratios(result,
                                             [&](const Row& a, const Row& b) {
                                                 return b.backend == host && a.backend != host &&
                                                        a.backend != reference && a.fractal == b.fractal &&
                                                        a.precision == b.precision;
                                             }),
                    .to_first_value = {},
                    .to_previous_value = {}};
    for (const Row& row : result.rows) {
        const Row* first = nullptr;
        const Row* previous = nullptr;
        for (const Row& other : result.rows) {
            if (&other == &row) break;
            if (!same_sweep(result, other, row)) continue;
            if (first == nullptr) first = &other;
            if (other.timed() && same_shape(other, row)) previous = &other;
        }
        if (!row.timed()) continue;
        if (first != nullptr && first->timed()) found.to_first_value.push_back(ratio_of(row, *first));
        if (previous != nullptr) found.to_previous_value.push_back(ratio_of(row, *previous));
    }
    return found;
}

}  // namespace

Result derived(Result result)
{
    const bool baselines = result.study == standard_study || result.study == demo_study;
    for (Row& row : result.rows) {
        const bool scalar = baselines && is_scalar(result, row);
        row.application = row.backend + (scalar ? "-scalar" : "");
        row.figures = row.timed() ? std::optional(figures_of(result, row)) : std::nullopt;
    }
    result.questions = questions_of(result);
    return result;
}

}  // namespace mandelmarch::bench
