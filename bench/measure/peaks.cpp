// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/peaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bench/measure/interruption.h"
#include "bench/measure/cases.h"
#include "core/text/error.h"

namespace mandelmarch::bench {
namespace {

constexpr double near_enough = 0.05;
constexpr int most_repeats = 3;  // further measurements of a doubtful peak

// Returns the second highest rate; 0 if there is none.
double second(const std::vector<Peak>& peaks) { return peaks.size() < 2 ? 0 : peaks[1].rate; }

bool is_doubtful(const std::vector<Peak>& peaks) { return second(peaks) < (1 - near_enough) * peaks.front().rate; }

}  // namespace

void PeakRecord::add(const std::vector<Peak>& peaks)
{
    for (const Peak& peak : peaks) {
        auto same = std::ranges::find_if(
            measured_, [&](const std::vector<Peak>& known) { return known.front().same_device(peak); });
        if (same == measured_.end()) same = measured_.insert(same, std::vector<Peak>());
        same->insert(std::ranges::lower_bound(*same, peak.rate, std::greater(), &Peak::rate), peak);
    }
}

std::vector<Peak> PeakRecord::best() const
{
    std::vector<Peak> found;
    for (const std::vector<Peak>& peaks : measured_) found.push_back(peaks.front());
    return found;
}

std::vector<Peak> PeakRecord::doubtful() const
{
    std::vector<Peak> found;
    for (const std::vector<Peak>& peaks : measured_) {
        if (is_doubtful(peaks)) found.push_back(peaks.front());
    }
    return found;
}

std::vector<std::string> PeakRecord::warnings() const
{
    std::vector<std::string> found;
    for (const std::vector<Peak>& peaks : measured_) {
        if (!is_doubtful(peaks)) continue;
        const Peak& best = peaks.front();
        found.push_back(fmt::format("peak: {} {}, {}: {:.1f} GFLOP/s is the best of {}, the next is {:.1f}",
                                    best.backend, best.device, name_of(best.precision), 1e-9 * best.rate, peaks.size(),
                                    1e-9 * second(peaks)));
    }
    return found;
}

std::vector<Peak> measure_peaks(const Registry& registry, const Options& options, const Phase& phase,
                                const std::function<bool(const Peak&)>& wanted)
{
    struct Asked {
        const Backend* backend;
        Peak peak;
    };
    std::vector<Asked> asked;
    for (const auto& backend : registry.backends()) {
        // Any backend may reach the highest peak of a device. Therefore all backends are measured, including those that
        // are not timed.
        int index = 0;
        for (const Device& device : listing_of(*backend).devices) {
            for (const Precision precision : options.precisions) {
                Peak peak{platform_of(device), std::string(backend->name()), index, precision, 0};
                if (wanted(peak)) asked.push_back({backend.get(), std::move(peak)});
            }
            ++index;
        }
    }
    std::vector<Peak> peaks;
    for (std::size_t i = 0; i < asked.size() && interrupted() == 0; ++i) {
        Peak& peak = asked[i].peak;
        phase({"multiply-add peaks", static_cast<double>(i) / static_cast<double>(asked.size()),
               fmt::format("{} {}", peak.backend, name_of(peak.precision))});
        try {
            const auto rate = asked[i].backend->multiply_add_peak({.device = peak.device, .precision = peak.precision});
            if (!rate) continue;
            peak.rate = *rate;
            peaks.push_back(std::move(peak));
        } catch (const Error&) {
            continue;  // for example, no support for double; the device's rows report a failure of the device
        }
    }
    return peaks;
}

PeakRecord settled_peaks(PeakRecord record, const PeakMeasurement& again)
{
    for (int i = 0; i < most_repeats; ++i) {
        const std::vector<Peak> doubtful = record.doubtful();
        if (doubtful.empty()) break;
        record.add(again([&](const Peak& peak) {
            return std::ranges::any_of(doubtful, [&](const Peak& d) { return d.same_device(peak); });
        }));
    }
    return record;
}

}  // namespace mandelmarch::bench
