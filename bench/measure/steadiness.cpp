// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/steadiness.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <utility>

#include "bench/result/figures.h"
#include "bench/statistics/table.h"
#include "core/os/cores.h"
#include "core/os/files.h"
#include "core/text/text.h"

namespace mandelmarch::bench {
namespace {

// Thresholds of warnings.
constexpr double much_load = 0.3;     // running threads per core, before the start
constexpr double much_stolen = 0.01;  // fraction of the processors' time
constexpr double much_other = 0.05;   // fraction of the processors' time, used by other processes
constexpr double much_drift = 0.05;   // relative change of the clock frequency
constexpr double much_spread = 0.05;  // median absolute deviation / median

double fastest_clock()
{
    std::ifstream file("/proc/cpuinfo");
    double fastest = 0;
    for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("cpu MHz")) continue;
        std::istringstream value(line.substr(line.find(':') + 1));
        double megahertz = 0;
        if (value >> megahertz) fastest = std::max(fastest, megahertz);
    }
    return fastest;
}

struct Usage {
    int parent = 0;
    double ticks = 0;
};

// Parses /proc/PID/stat (proc(5)). Field 2, the name in parentheses, may contain any character. Field 4 is the parent.
// Fields 14 to 17 are the user and system time of the process, and of the children for which it has waited.
Usage usage_of(const std::filesystem::path& process)
{
    std::ifstream file(process / "stat");
    std::string line;
    std::getline(file, line);
    const auto bracket = line.rfind(')');
    if (bracket == std::string::npos) return {};
    std::istringstream fields(line.substr(bracket + 1));
    Usage usage;
    std::string skipped;
    fields >> skipped >> usage.parent;
    for (int field = 5; field < 14; ++field) fields >> skipped;
    for (int field = 14; field < 18; ++field) {
        double ticks = 0;
        fields >> ticks;
        usage.ticks += ticks;
    }
    return usage;
}

// Returns the seconds of user and system time that this process and all its descendants have used since they started.
// An ended process counts as soon as its parent has waited for it.
double process_tree_seconds()
{
    std::map<int, Usage> all;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const std::string name = entry.path().filename().string();
        int id = 0;
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), id);
        if (error == std::errc() && end == name.data() + name.size()) all[id] = usage_of(entry.path());
    }
    std::set<int> family{getpid()};
    for (bool grown = true; grown;) {
        grown = false;
        for (const auto& [id, usage] : all) {
            if (family.contains(usage.parent)) grown = family.insert(id).second || grown;
        }
    }
    double ticks = 0;
    for (const int id : family) ticks += all[id].ticks;
    return ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
}

// Returns a warning if samples of configurations spread too much; empty if they do not.
std::string spread_of(const Result& result)
{
    int count = 0;
    std::pair<double, std::string> worst;
    for (const Row& row : result.rows) {
        if (!row.timed() || row.samples.size() < 3) continue;
        const Summary s = summary(kernel_times(row));
        if (s.mad <= much_spread * s.median) continue;
        ++count;
        worst = std::max(worst, {s.mad / s.median, row.name()});
    }
    if (count == 0) return {};
    return fmt::format("spread: {} of {} rows deviate by more than {:.0f} % of their median, {} by {:.0f} %", count,
                       result.rows.size(), 100 * much_spread, worst.second, 100 * worst.first);
}

// Returns the numbers of threads that CPU backends chose by default, "openmp 1, opencl 2"; empty if all are equal.
std::string unlike_threads(const Result& result)
{
    std::vector<std::pair<std::string, int>> known;
    bool unlike = false;
    for (const Row& row : result.rows) {
        if (!row.timed() || row.is_gpu || row.setting.threads > 0 || row.threads == 0) continue;
        if (row.verification.is_expected) continue;
        const std::pair<std::string, int> here{row.backend, row.threads};
        if (std::ranges::find(known, here) != known.end()) continue;
        unlike = unlike || (!known.empty() && known.front().second != row.threads);
        known.push_back(here);
    }
    const auto text_of = [](const auto& one) { return fmt::format("{} {}", one.first, one.second); };
    return unlike ? fmt::format("{}", fmt::join(mapped(known, text_of), ", ")) : std::string();
}

}  // namespace

Steadiness::Steadiness() : start_(look()) {}

Steadiness::Snapshot Steadiness::look()
{
    Snapshot now;
    std::istringstream(first_line("/proc/loadavg")) >> now.load;
    now.frequency = fastest_clock();
    // Fields: cpu user nice system idle iowait irq softirq steal, in ticks since boot.
    std::istringstream line(first_line("/proc/stat"));
    std::string name;
    double ticks[8] = {};
    line >> name;
    for (double& value : ticks) line >> value;
    const auto per_second = static_cast<double>(sysconf(_SC_CLK_TCK));
    for (const double value : ticks) now.processors += value / per_second;
    now.stolen = ticks[7] / per_second;
    now.throttling = throttling();
    now.others = (ticks[0] + ticks[1] + ticks[2]) / per_second - process_tree_seconds();
    return now;
}

nlohmann::ordered_json Steadiness::during() const
{
    const Snapshot end = look();
    const double processors = std::max(1e-9, end.processors - start_.processors);
    return {{"load_at_start", start_.load},
            {"load_at_end", end.load},
            {"megahertz_at_start", start_.frequency},
            {"megahertz_at_end", end.frequency},
            {"stolen_share", (end.stolen - start_.stolen) / processors},
            {"others_share", std::max(0.0, (end.others - start_.others) / processors)},
            {"quota_periods", end.throttling.periods - std::min(end.throttling.periods, start_.throttling.periods)},
            {"throttled_periods",
             end.throttling.throttled - std::min(end.throttling.throttled, start_.throttling.throttled)}};
}

std::vector<std::string> Steadiness::warnings(const Result& result) const
{
    std::vector<std::string> found;
    const auto warn = [&](bool doubtful, const std::string& text) {
        if (doubtful) found.push_back(text);
    };
    const nlohmann::ordered_json now = during();
    const Cores mine = mandelmarch::cores();
    const double cores = mine.machine;  // all cores, because the load is that of the whole machine
    warn(start_.load > much_load * cores,
         fmt::format("load: {:.1f} threads were running on {} cores before the start", start_.load, cores));
    const double others = now["others_share"];
    warn(others > much_other,
         fmt::format("load: other processes took {:.0f} % of the processors during the measurement", 100 * others));
    const double stolen = now["stolen_share"];
    warn(stolen > much_stolen, fmt::format("load: the hypervisor took {:.0f} % of the processors away", 100 * stolen));
    const std::uint64_t throttled = now["throttled_periods"];
    warn(throttled > 0, fmt::format("quota: the program was stopped in {} of {} periods", throttled,
                                    now["quota_periods"].get<std::uint64_t>()));
    warn(throttled == 0 && mine.quota && *mine.quota < mine.given,
         fmt::format("quota: {:.2g} cores' processor time is allowed on {} cores", mine.quota.value_or(0), mine.given));
    warn(!binding().empty(),
         fmt::format("binding: {} binds OpenMP's threads to cores; other backends' threads may run on all {} cores",
                     binding(), mine.given));
    const std::string unlike = unlike_threads(result);
    warn(!unlike.empty(), "threads: the CPU backends used different numbers of threads: " + unlike);
    const double before = start_.frequency;
    const double after = now["megahertz_at_end"];
    warn(before > 0 && std::abs(after - before) > much_drift * before,
         fmt::format("frequency: the clock went from {:.0f} to {:.0f} MHz", before, after));
    const std::string governor = first_line("/sys/devices/system/cpu/cpu0/cpufreq/scaling_governor");
    warn(!governor.empty() && governor != "performance",
         fmt::format("frequency: the governor is {}, not performance", governor));
    const std::string spread = spread_of(result);
    warn(!spread.empty(), spread);
    return found;
}

}  // namespace mandelmarch::bench
