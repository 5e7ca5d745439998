// SPDX-License-Identifier: Apache-2.0
// Energy of processors (RAPL) and of GPUs (NVML), and the state of GPUs.
#pragma once

#include <filesystem>
#include <memory>
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

class Telemetry {
public:
    explicit Telemetry(const TelemetrySources& sources = {});
    ~Telemetry();

    // Returns the energy in joules since construction of all processors and NVIDIA GPUs of the machine whose counters
    // can be read; nullopt if there are none. A counter must be read before it wraps around twice.
    std::optional<double> joules();

    // Returns a list of {"name", "watts", "sm_megahertz", "throttled"}, one for each NVIDIA GPU, with null for what the
    // driver does not give; {"missing": why} if there is no GPU.
    nlohmann::ordered_json gpus() const;

private:
    class Nvml;
    struct Package {
        std::filesystem::path file;
        double last = 0, range = 0;  // microjoules; the counter wraps around to 0 after `range`
    };

    std::unique_ptr<Nvml> nvml_;
    std::vector<Package> packages_;
    double of_packages_ = 0;               // microjoules since construction
    std::optional<double> gpus_at_start_;  // joules
};

}  // namespace mandelmarch::bench
