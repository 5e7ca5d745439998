// SPDX-License-Identifier: Apache-2.0
#include "bench/result/platforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "bench/result/differences.h"
#include "bench/result/figures.h"

namespace mandelmarch::bench {
namespace {

std::set<std::string> platforms_of(const Result& result)
{
    std::set<std::string> names;
    for (const Row& row : result.rows) names.insert(row.platform);
    names.erase("");
    return names;
}

bool is_cpu(const Result& result, const std::string& platform)
{
    return std::ranges::any_of(result.rows, [&](const Row& row) { return row.platform == platform && !row.is_gpu; });
}

// Returns true if both results contain the boot ID of their system, and the IDs are equal.
bool same_boot(const Result& a, const Result& b)
{
    const auto boot = value_at(a.environment, "/os/boot");
    return boot.is_string() && boot == value_at(b.environment, "/os/boot");
}

// Returns true if the facts about the CPU are the same in both results. A fact that only one result has is ignored.
bool same_facts(const Result& a, const Result& b)
{
    for (const char* fact : {"/cpu/stepping", "/cpu/flags", "/cpu/caches", "/cpu/cores_usable"}) {
        const auto one = value_at(a.environment, fact);
        const auto other = value_at(b.environment, fact);
        if (!one.is_null() && !other.is_null() && !same_fact(one, other)) return false;
    }
    return true;
}

bool same_peaks(const Result& a, const Result& b, const std::string& platform)
{
    for (const Precision precision : {Precision::f64, Precision::f32}) {
        const Peak* one = peak_of(a, platform, precision);
        const Peak* other = peak_of(b, platform, precision);
        if (one == nullptr || other == nullptr || !(one->rate > 0) || !(other->rate > 0)) continue;
        if (std::max(one->rate, other->rate) > same_peak * std::min(one->rate, other->rate)) return false;
    }
    return true;
}

void rename(Result& result, const std::string& platform, const std::string& name)
{
    for (Row& row : result.rows) {
        if (row.platform == platform) row.platform = name;
    }
    for (Peak& peak : result.peaks) {
        if (peak.platform == platform) peak.platform = name;
    }
}

}  // namespace

std::vector<Result> disambiguated(std::span<const Result> results)
{
    std::vector<Result> renamed(results.begin(), results.end());
    std::map<std::string, std::vector<std::size_t>> holders;  // indices of the results that have the platform
    for (std::size_t i = 0; i < results.size(); ++i) {
        for (const std::string& name : platforms_of(results[i])) holders[name].push_back(i);
    }
    for (const auto& [name, indices] : holders) {
        const std::string& platform = name;     // clang 14 cannot capture a structured binding
        std::vector<std::size_t> machines;      // index of the first result of each machine
        std::map<std::size_t, std::size_t> of;  // index of each result's machine in `machines`
        for (const std::size_t i : indices) {
            const auto same = std::ranges::find_if(machines, [&](std::size_t j) {
                const bool cpu = is_cpu(results[i], platform) && is_cpu(results[j], platform);
                if (cpu && !same_facts(results[i], results[j])) return false;
                return (cpu && same_boot(results[i], results[j])) || same_peaks(results[i], results[j], platform);
            });
            of[i] = static_cast<std::size_t>(same - machines.begin());
            if (same == machines.end()) machines.push_back(i);
        }
        if (machines.size() < 2) continue;
        for (const auto& [i, machine] : of) {
            rename(renamed[i], platform, fmt::format("{}, machine {}", platform, machine + 1));
        }
    }
    return renamed;
}

}  // namespace mandelmarch::bench
