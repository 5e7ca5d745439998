// SPDX-License-Identifier: Apache-2.0
// Sensor readings during the measurement: energy, clock frequencies and throttling of GPUs.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace mandelmarch::bench {

// Sources of the readings on Linux. Tests use other sources.
struct TelemetrySources {
    std::filesystem::path powercap = "/sys/class/powercap";
    std::string nvml = "libnvidia-ml.so.1";
};

// Takes readings on construction and at each call of since_start(). Values that the system does not provide are
// "missing", with the reason; nothing is estimated.
class Telemetry {
public:
    explicit Telemetry(TelemetrySources sources = {});

    // Returns {"energy", "gpus"}; each is {"missing": why} or
    //   energy: {"seconds", "domains": [{"name", "joules"}]}, from RAPL, for all processors of the machine
    //   gpus: a list of readings (bench/result/gpu_reading.h) from NVML, each for the whole GPU. joules: energy since
    //     construction; all other values are current.
    nlohmann::ordered_json since_start() const;

private:
    struct Domain {
        std::string name;
        std::filesystem::path file;
        double start = 0, range = 0;  // microjoules; the reading wraps around to 0 after `range`
    };
    void look_for_domains();
    nlohmann::ordered_json energy() const;

    TelemetrySources sources_;
    double start_ = 0;  // seconds, steady clock
    std::vector<Domain> domains_;
    std::string no_energy_;
    std::vector<std::optional<double>> gpu_joules_;  // at the start
};

}  // namespace mandelmarch::bench
