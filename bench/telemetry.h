// SPDX-License-Identifier: Apache-2.0
// What the machine tells of itself while it is measured: energy, processors' counters, clocks and throttling of GPUs.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace mandelmarch::bench {

// Where Linux tells it. Tests give folders of their own.
struct TelemetrySources {
    std::filesystem::path powercap = "/sys/class/powercap";
    std::string nvml = "libnvidia-ml.so.1";
};

// Looks when it is made, and again when it is asked. Nothing is estimated: what the machine does not tell is "missing",
// with the reason.
class Telemetry {
public:
    explicit Telemetry(TelemetrySources sources = {});
    ~Telemetry();
    Telemetry(const Telemetry&) = delete;
    Telemetry& operator=(const Telemetry&) = delete;

    // {"energy", "counters", "gpus"}, each {"missing": why} or
    //   energy: {"seconds", "domains": [{"name", "joules"}]}, by RAPL, of the whole machine's processors
    //   counters: {"cycles", "instructions", ...} of the threads of this process, and of what they start, by perf; each
    //   may
    //     be null
    //   gpus: [{"name", "joules", "watts", "celsius", "sm_megahertz", "most_sm_megahertz", "memory_megahertz",
    //     "throttled"}], by NVML, of the whole GPU; joules since the first look, all others now; null where unknown.
    //     throttled: why the clock is lower than it could be, "none" if it is not.
    nlohmann::ordered_json since_start() const;

private:
    struct Domain {
        std::string name;
        std::filesystem::path file;
        double start = 0, range = 0;  // microjoules; it begins again at 0 behind the range
    };
    struct Counter {
        std::string name;
        std::vector<int> descriptors;  // one for each thread of this process
        std::string missing;
    };
    void look_for_domains();
    void open_counters();
    nlohmann::ordered_json energy() const;
    nlohmann::ordered_json counters() const;

    TelemetrySources sources_;
    double start_ = 0;  // seconds of a steady clock
    std::vector<Domain> domains_;
    std::string no_energy_;
    std::vector<Counter> counters_;
    std::vector<double> gpu_joules_;  // at the start; below 0 where unknown
};

}  // namespace mandelmarch::bench
