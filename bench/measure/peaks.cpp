// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/peaks.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "bench/measure/cases.h"
#include "bench/measure/interruption.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

constexpr double near_enough = 0.05;
constexpr int most_repeats = 3;  // further measurements of a doubtful peak

std::ptrdiff_t count_of(const std::vector<Peak>& measured, const Peak& device, double least_rate)
{
    return std::ranges::count_if(measured,
                                 [&](const Peak& peak) { return peak.same_device(device) && peak.rate >= least_rate; });
}

}  // namespace

std::vector<Peak> doubtful(const std::vector<Peak>& measured)
{
    std::vector<Peak> found;
    raise_peaks(found, measured);
    std::erase_if(found, [&](const Peak& best) { return count_of(measured, best, (1 - near_enough) * best.rate) > 1; });
    return found;
}

std::vector<std::string> peak_warnings(const std::vector<Peak>& measured)
{
    return mapped(doubtful(measured), [&](const Peak& best) {
        return fmt::format(
            "peak: {} {}, {}: one of {} measurements reached {:.1f} GFLOP/s, all others stay below {:.0f} %",
            best.backend, best.device, name_of(best.precision), count_of(measured, best, 0), 1e-9 * best.rate,
            100 * (1 - near_enough));
    });
}

std::vector<Peak> measure_peaks(const Registry& registry, const Options& options, const Phase& phase,
                                const std::function<bool(const Peak&)>& wanted)
{
    struct Measured {
        const Backend* backend;
        Peak peak;
    };
    std::vector<Measured> all;
    for (const auto& backend : registry.backends()) {
        // Any backend may reach the highest peak of a device. Therefore all backends are measured, including those that
        // are not timed.
        int index = 0;
        for (const Device& device : listing_of(*backend).devices) {
            for (const Precision precision : options.precisions) {
                Peak peak{platform_of(device), std::string(backend->name()), index, precision, 0};
                if (wanted(peak)) all.push_back({backend.get(), std::move(peak)});
            }
            ++index;
        }
    }
    std::vector<Peak> peaks;
    for (std::size_t i = 0; i < all.size() && interrupted() == 0; ++i) {
        Peak& peak = all[i].peak;
        phase({"multiply-add peaks", static_cast<double>(i) / static_cast<double>(all.size()),
               fmt::format("{} {}", peak.backend, name_of(peak.precision))});
        try {
            const auto rate = all[i].backend->multiply_add_peak({.device = peak.device, .precision = peak.precision});
            if (!rate) continue;
            peak.rate = *rate;
            peaks.push_back(std::move(peak));
        } catch (const Error&) {
            continue;  // for example, no support for double; the device's rows report a failure of the device
        }
    }
    return peaks;
}

std::vector<Peak> settled_peaks(std::vector<Peak> measured, const PeakMeasurement& again)
{
    for (int i = 0; i < most_repeats; ++i) {
        const std::vector<Peak> open = doubtful(measured);
        if (open.empty()) break;
        for (const Peak& peak : again([&](const Peak& device) { return count_of(open, device, 0) > 0; }))
            measured.push_back(peak);
    }
    return measured;
}

}  // namespace mandelmarch::bench
