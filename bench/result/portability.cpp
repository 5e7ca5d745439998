// SPDX-License-Identifier: Apache-2.0
#include "bench/result/portability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <compare>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "bench/result/figures.h"
#include "bench/result/platforms.h"

namespace mandelmarch::bench {
namespace {

constexpr int draws = 1000;

struct Entry {
    const Result* result;
    const Row* row;
    std::vector<double> times;    // kernel times of all runs
    std::vector<double> medians;  // one for each run
};

struct Problem {
    std::string fractal;
    Precision precision;
    Mode mode;
    int width, height;
    auto operator<=>(const Problem&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 misreads <=>
};

using Seconds = std::map<std::pair<std::string, std::string>, double>;  // by application and platform

// Returns a random time, from the distribution of the times that the configuration may really have.
// If there are several runs, the logarithm of the time is the mean of the runs' logarithms plus the mean's standard
// error times a random value of Student's t. Then 95 % of the times lie within run_interval(). This is Weerahandi's
// generalized interval (JASA 88, 1993), which also holds for quantities computed from several configurations.
// If there is one run, the time is the median of the run's times, resampled with replacement. Such times show only the
// scatter within that run.
double drawn(const Entry& entry, std::mt19937_64& random)
{
    if (entry.medians.size() < 2) {
        std::vector<double> times;
        for (std::size_t i = 0; i < entry.times.size(); ++i)
            times.push_back(entry.times[random() % entry.times.size()]);
        return median(std::move(times));
    }
    const Moments m = moments(entry.medians);
    std::student_t_distribution<double> t(m.degrees);
    return std::exp(m.mean + t(random) * std::sqrt(m.variance_of_mean));
}

// Times of all backends on all platforms for one problem, and the efficiencies derived from them.
class PlatformTimes {
public:
    void add(const Result& result, const Row& row)
    {
        platforms_.insert(row.platform);
        applications_.insert(row.backend);
        platforms_of_[&result].insert(row.platform);
        applications_of_[&result].insert(row.backend);
        const std::vector<double> times = kernel_times(row);
        if (!row.timed() || !std::ranges::all_of(times, [](double s) { return s > 0; })) return;
        Entry& entry = entries_[{row.backend, row.platform}];
        if (entry.row != nullptr && median(times) >= median(entry.times)) return;
        entry = {&result, &row, times, run_medians(row)};
    }

    // Records that the result contains this backend without a device. The backend then counts as unsupported on all of
    // the result's platforms.
    void add_unavailable(const Result& result, const std::string& application)
    {
        if (platforms_of_.contains(&result)) applications_of_[&result].insert(application);
    }

    // Returns true if a result contains both the platform and the application, even if no row has both.
    bool is_measured(const std::string& application, const std::string& platform) const
    {
        return std::ranges::any_of(platforms_of_, [&](const auto& of) {
            return of.second.contains(platform) && applications_of_.at(of.first).contains(application);
        });
    }

    std::vector<std::string> not_measured(const std::string& application) const
    {
        std::vector<std::string> found(platforms_.begin(), platforms_.end());
        std::erase_if(found, [&](const std::string& platform) { return is_measured(application, platform); });
        return found;
    }

    // Returns the kernel time of each application on each platform: the median, or, if `random` is given, a random
    // value (drawn()).
    Seconds seconds(std::mt19937_64* random) const
    {
        Seconds found;
        for (const auto& [key, entry] : entries_) {
            found[key] = random != nullptr ? drawn(entry, *random) : median(entry.times);
        }
        return found;
    }

    // Returns the application's efficiencies on the platforms on which it was measured.
    std::vector<OnPlatform> efficiencies(const std::string& application, const Seconds& seconds) const
    {
        std::vector<OnPlatform> found;
        for (const std::string& platform : platforms_) {
            if (!is_measured(application, platform)) continue;
            OnPlatform on{.platform = platform};
            const auto mine = seconds.find({application, platform});
            if (mine != seconds.end()) on.seconds = mine->second;
            if (on.seconds > 0) {
                on.application = best(platform, seconds) / on.seconds;
                const Entry& entry = entries_.at({application, platform});
                const Peak* peak = peak_of(*entry.result, platform, entry.row->precision);
                on.architecture.reset();
                if (peak != nullptr && peak->rate > 0 && entry.row->operations > 0) {
                    on.architecture = entry.row->operations / on.seconds / peak->rate;
                }
            }
            found.push_back(std::move(on));
        }
        return found;
    }

private:
    // Returns the shortest time of any application on the platform.
    double best(const std::string& platform, const Seconds& seconds) const
    {
        double best = std::numeric_limits<double>::infinity();
        for (const std::string& application : applications_) {
            const auto found = seconds.find({application, platform});
            if (found != seconds.end()) best = std::min(best, found->second);
        }
        return best;
    }

    std::set<std::string> platforms_, applications_;
    std::map<const Result*, std::set<std::string>> platforms_of_, applications_of_;  // in each result with the problem
    std::map<std::pair<std::string, std::string>, Entry> entries_;                   // by application and platform
};

double by_application(const std::vector<OnPlatform>& platforms)
{
    std::vector<double> efficiencies;
    for (const OnPlatform& on : platforms) efficiencies.push_back(on.application);
    return performance_portability(efficiencies);
}

// Returns nothing if all platforms are supported, but a platform's peak is not known.
std::optional<double> by_architecture(const std::vector<OnPlatform>& platforms)
{
    std::vector<double> efficiencies;
    for (const OnPlatform& on : platforms) {
        if (!on.architecture) continue;
        if (*on.architecture == 0) return 0;
        efficiencies.push_back(*on.architecture);
    }
    if (efficiencies.size() < platforms.size()) return std::nullopt;
    return performance_portability(efficiencies);
}

// Returns the middle 95 % of the values, widened to contain `value`.
Interval middle_of(std::vector<double> values, double value)
{
    std::ranges::sort(values);
    const auto tail = static_cast<std::size_t>((1 - confidence) / 2 * static_cast<double>(values.size()));
    return {std::min(values[tail], value), std::max(values[values.size() - 1 - tail], value)};
}

std::vector<CascadeStep> cascade_of(std::vector<OnPlatform> platforms)
{
    std::ranges::stable_sort(platforms, std::ranges::greater(), &OnPlatform::application);
    std::vector<CascadeStep> steps;
    std::vector<double> so_far;
    for (const OnPlatform& platform : platforms) {
        so_far.push_back(platform.application);
        steps.push_back({platform.platform, platform.application, performance_portability(so_far)});
    }
    return steps;
}

Portability of(const Problem& problem, const PlatformTimes& field, const std::string& application)
{
    Portability p;
    p.problem = fmt::format("{} {}x{}", problem.fractal, problem.width, problem.height);
    p.fractal = problem.fractal;
    p.precision = problem.precision;
    p.mode = problem.mode;
    p.width = problem.width;
    p.height = problem.height;
    p.application = application;
    p.not_measured = field.not_measured(application);
    p.platforms = field.efficiencies(application, field.seconds(nullptr));
    p.application_portability = by_application(p.platforms);
    p.architecture_portability = by_architecture(p.platforms);
    // The metric is computed from many random draws of the kernel times (drawn()). The intervals are percentiles of
    // these values.
    std::mt19937_64 random(1);
    std::vector<double> of_application;
    std::vector<double> of_architecture;
    for (int i = 0; i < draws; ++i) {
        const std::vector<OnPlatform> again = field.efficiencies(application, field.seconds(&random));
        of_application.push_back(by_application(again));
        of_architecture.push_back(by_architecture(again).value_or(0));
    }
    p.application_interval = middle_of(std::move(of_application), p.application_portability);
    if (p.architecture_portability) {
        p.architecture_interval = middle_of(std::move(of_architecture), *p.architecture_portability);
    }
    p.cascade = cascade_of(p.platforms);
    return p;
}

}  // namespace

double performance_portability(std::span<const double> efficiencies)
{
    double sum = 0;
    for (const double e : efficiencies) {
        if (!(e > 0)) return 0;
        sum += 1 / e;
    }
    return efficiencies.empty() ? 0 : static_cast<double>(efficiencies.size()) / sum;
}

std::vector<Portability> portability(std::span<const Result> given)
{
    const std::vector<Result> results = disambiguated(given);
    std::map<Problem, PlatformTimes> fields;
    std::set<std::string> applications;
    for (const Result& result : results) {
        const std::string reference = result.reference();
        for (const Row& row : result.rows) {
            if (!row.sweep_value.empty() || row.backend == reference) continue;
            applications.insert(row.backend);
            if (row.platform.empty()) continue;  // a backend without a device
            fields[{row.fractal, row.precision, row.mode, row.setting.width, row.setting.height}].add(result, row);
        }
    }
    for (const Result& result : results) {
        for (const Row& row : result.rows) {
            if (!row.platform.empty()) continue;
            for (auto& [problem, field] : fields) field.add_unavailable(result, row.backend);
        }
    }
    std::vector<Portability> found;
    for (const auto& [problem, field] : fields) {
        for (const std::string& application : applications) found.push_back(of(problem, field, application));
    }
    return found;
}

}  // namespace mandelmarch::bench
