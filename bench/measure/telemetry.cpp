// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/telemetry.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "bench/result/gpu_reading.h"
#include "core/os/files.h"
#include "core/os/stopwatch.h"

namespace mandelmarch::bench {
namespace {

namespace fs = std::filesystem;

double now() { return std::chrono::duration<double>(Clock::now().time_since_epoch()).count(); }

std::optional<double> number_in(const fs::path& path)
{
    std::ifstream file(path);
    double value = 0;
    return file >> value ? std::optional(value) : std::nullopt;
}

Json missing(const std::string& why) { return {{"missing", why}}; }

struct GpuReadings {
    std::vector<GpuReading> gpus;  // joules: since the driver was loaded
    std::string missing;           // why there are no GPUs; empty if there are some
};

// Declarations from NVML's API reference. With them, the build does not need NVML's header.
using GpuHandle = void*;
constexpr int success = 0;
constexpr unsigned sm_clock = 1, memory_clock = 2, gpu_temperature = 0;
constexpr std::array<std::pair<unsigned long long, const char*>, 8> reasons{{{0x02, "clocks set by applications"},
                                                                             {0x04, "power cap"},
                                                                             {0x08, "hardware slowdown"},
                                                                             {0x10, "synchronised boost"},
                                                                             {0x20, "software thermal slowdown"},
                                                                             {0x40, "hardware thermal slowdown"},
                                                                             {0x80, "hardware power brake"},
                                                                             {0x100, "display clocks"}}};
constexpr unsigned long long idle = 0x01;

class Library {
public:
    explicit Library(const std::string& name) : handle_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL), dlclose) {}
    explicit operator bool() const { return handle_ != nullptr; }

    // Calls a function of the library. Returns false if the library lacks it or the call fails.
    template <class... Arguments>
    bool call(const char* name, Arguments... arguments) const
    {
        using Function = int (*)(Arguments...);
        const auto function = reinterpret_cast<Function>(dlsym(handle_.get(), name));
        return function != nullptr && function(arguments...) == success;
    }

    // Calls a function whose last argument is a pointer to its result. Returns the result in multiples of `unit`, or
    // nullopt if the call fails.
    template <class Number, class... Arguments>
    std::optional<double> number(double unit, const char* name, Arguments... arguments) const
    {
        Number value = 0;
        if (!call(name, arguments..., &value)) return std::nullopt;
        return unit * static_cast<double>(value);
    }

private:
    std::unique_ptr<void, int (*)(void*)> handle_;
};

std::string words(unsigned long long bits)
{
    std::string text;
    for (const auto& [bit, word] : reasons) {
        if ((bits & bit) != 0) text += fmt::format("{}{}", text.empty() ? "" : ", ", word);
    }
    if (text.empty() && (bits & idle) != 0) return "idle";
    return text.empty() ? "none" : text;
}

GpuReading reading_of(const Library& nvml, GpuHandle device)
{
    GpuReading reading;
    std::array<char, 96> name{};
    if (nvml.call("nvmlDeviceGetName", device, name.data(), static_cast<unsigned>(name.size())))
        reading.name = name.data();
    reading.watts = nvml.number<unsigned>(1e-3, "nvmlDeviceGetPowerUsage", device);
    reading.celsius = nvml.number<unsigned>(1, "nvmlDeviceGetTemperature", device, gpu_temperature);
    reading.sm = nvml.number<unsigned>(1, "nvmlDeviceGetClockInfo", device, sm_clock);
    reading.most_sm = nvml.number<unsigned>(1, "nvmlDeviceGetMaxClockInfo", device, sm_clock);
    reading.memory = nvml.number<unsigned>(1, "nvmlDeviceGetClockInfo", device, memory_clock);
    reading.joules = nvml.number<unsigned long long>(1e-3, "nvmlDeviceGetTotalEnergyConsumption", device);
    unsigned long long bits = 0;
    if (nvml.call("nvmlDeviceGetCurrentClocksThrottleReasons", device, &bits)) reading.throttled = words(bits);
    return reading;
}

// Returns a reading of every NVIDIA GPU. `library`: file name of NVML, as passed to dlopen().
GpuReadings gpu_readings(const std::string& library)
{
    const Library nvml(library);
    if (!nvml) return {.gpus = {}, .missing = library + " is not installed"};
    if (!nvml.call("nvmlInit_v2")) return {.gpus = {}, .missing = library + " finds no driver"};
    GpuReadings found;
    unsigned count = 0;
    nvml.call("nvmlDeviceGetCount_v2", &count);
    for (unsigned i = 0; i < count; ++i) {
        GpuHandle device = nullptr;
        if (nvml.call("nvmlDeviceGetHandleByIndex_v2", i, &device)) found.gpus.push_back(reading_of(nvml, device));
    }
    nvml.call("nvmlShutdown");
    if (found.gpus.empty()) found.missing = library + " finds no GPU";
    return found;
}

}  // namespace

Telemetry::Telemetry(TelemetrySources sources) : sources_(std::move(sources)), start_(now())
{
    look_for_domains();
    for (const GpuReading& gpu : gpu_readings(sources_.nvml).gpus) gpu_joules_.push_back(gpu.joules);
}

// Reads Linux' powercap interface (Documentation/power/powercap), for Intel and AMD. It has one folder per domain. If a
// folder's name has one colon, the domain is a whole package (or, on some Intel processors, the whole platform); if it
// has more, the domain is a part of a package.
void Telemetry::look_for_domains()
{
    std::error_code error;
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(sources_.powercap, error)) {
        if (fs::exists(entry.path() / "energy_uj", error)) folders.push_back(entry.path());
    }
    std::ranges::sort(folders);
    for (const fs::path& folder : folders) {
        const auto start = number_in(folder / "energy_uj");
        if (!start) {
            no_energy_ =
                fmt::format("{} cannot be read, which Linux allows root only", (folder / "energy_uj").string());
            continue;
        }
        domains_.push_back({.name = fmt::format("{} {}", folder.filename().string(), first_line(folder / "name")),
                            .file = folder / "energy_uj",
                            .start = *start,
                            .range = number_in(folder / "max_energy_range_uj").value_or(0)});
    }
    if (folders.empty()) no_energy_ = fmt::format("{} has no domain of RAPL", sources_.powercap.string());
}

Json Telemetry::energy() const
{
    Json domains = Json::array();
    for (const Domain& domain : domains_) {
        const auto end = number_in(domain.file);
        if (!end) continue;
        const double used = *end - domain.start;
        domains.push_back({{"name", domain.name}, {"joules", 1e-6 * (used < 0 ? used + domain.range : used)}});
    }
    if (domains.empty()) return missing(no_energy_);
    return {{"seconds", now() - start_}, {"domains", domains}};
}

Json Telemetry::since_start() const
{
    GpuReadings readings = gpu_readings(sources_.nvml);
    for (std::size_t i = 0; i < readings.gpus.size(); ++i) {
        std::optional<double>& joules = readings.gpus[i].joules;
        const std::optional<double> start = i < gpu_joules_.size() ? gpu_joules_[i] : std::nullopt;
        joules = joules && start ? std::optional(*joules - *start) : std::nullopt;
    }
    return {{"energy", energy()},
            {"gpus", readings.missing.empty() ? to_json(readings.gpus, Form::facts) : missing(readings.missing)}};
}

}  // namespace mandelmarch::bench
