// SPDX-License-Identifier: Apache-2.0
#include "bench/measure/telemetry.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <utility>

#include "core/os/files.h"

namespace mandelmarch::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::optional<double> number_in(const fs::path& path)
{
    std::ifstream file(path);
    double value = 0;
    return file >> value ? std::optional(value) : std::nullopt;
}

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

// Declarations from NVML's API reference. With them, the build does not need NVML's header.
using GpuHandle = void*;
constexpr int success = 0;
constexpr unsigned sm_clock = 1;
constexpr std::array<std::pair<unsigned long long, const char*>, 8> reasons{{{0x02, "clocks set by applications"},
                                                                             {0x04, "power cap"},
                                                                             {0x08, "hardware slowdown"},
                                                                             {0x10, "synchronised boost"},
                                                                             {0x20, "software thermal slowdown"},
                                                                             {0x40, "hardware thermal slowdown"},
                                                                             {0x80, "hardware power brake"},
                                                                             {0x100, "display clocks"}}};
constexpr unsigned long long idle = 0x01;

std::string words(unsigned long long bits)
{
    std::string text;
    for (const auto& [bit, word] : reasons) {
        if ((bits & bit) != 0) text += fmt::format("{}{}", text.empty() ? "" : ", ", word);
    }
    if (text.empty() && (bits & idle) != 0) return "idle";
    return text.empty() ? "none" : text;
}

}  // namespace

// NVIDIA's library for the state of GPUs.
class Telemetry::Nvml {
public:
    explicit Nvml(const std::string& name) : library_(dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL))
    {
        if (library_ == nullptr) {
            missing = name + " is not installed";
        } else if (!call("nvmlInit_v2")) {
            missing = name + " finds no driver";
        } else {
            unsigned count = 0;
            call("nvmlDeviceGetCount_v2", &count);
            for (unsigned i = 0; i < count; ++i) {
                GpuHandle gpu = nullptr;
                if (call("nvmlDeviceGetHandleByIndex_v2", i, &gpu)) gpus.push_back(gpu);
            }
            if (gpus.empty()) missing = name + " finds no GPU";
        }
    }
    ~Nvml()
    {
        if (library_ == nullptr) return;
        call("nvmlShutdown");
        dlclose(library_);
    }
    Nvml(const Nvml&) = delete;
    Nvml& operator=(const Nvml&) = delete;

    // Calls a function of the library. Returns false if the library lacks it or the call fails.
    template <class... Arguments>
    bool call(const char* name, Arguments... arguments) const
    {
        using Function = int (*)(Arguments...);
        const auto function = reinterpret_cast<Function>(dlsym(library_, name));
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

    // Returns the energy of all GPUs since the driver was loaded; nullopt if no GPU has a counter.
    std::optional<double> joules() const
    {
        std::optional<double> sum;
        for (const GpuHandle gpu : gpus) {
            const auto of_gpu = number<unsigned long long>(1e-3, "nvmlDeviceGetTotalEnergyConsumption", gpu);
            if (of_gpu) sum = sum.value_or(0) + *of_gpu;
        }
        return sum;
    }

    std::vector<GpuHandle> gpus;
    std::string missing;  // why there are no GPUs; empty if there are some

private:
    void* library_;
};

// Packages are read from Linux' powercap interface (Documentation/power/powercap), for Intel and AMD. It has one folder
// for each domain: a package, a part of a package, or the whole platform.
Telemetry::Telemetry(const TelemetrySources& sources)
    : nvml_(std::make_unique<Nvml>(sources.nvml)), gpus_at_start_(nvml_->joules())
{
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(sources.powercap, error)) {
        const fs::path file = entry.path() / "energy_uj";  // only root may read it, on most systems
        const auto start = number_in(file);
        if (!start || !first_line(entry.path() / "name").starts_with("package")) continue;
        packages_.push_back({file, *start, number_in(entry.path() / "max_energy_range_uj").value_or(0)});
    }
}

Telemetry::~Telemetry() = default;

std::optional<double> Telemetry::joules()
{
    for (Package& package : packages_) {
        const double now = number_in(package.file).value_or(package.last);
        of_packages_ += now - package.last + (now < package.last ? package.range : 0);
        package.last = now;
    }
    const auto of_gpus = gpus_at_start_ ? nvml_->joules() : std::nullopt;
    if (!of_gpus && packages_.empty()) return std::nullopt;
    return 1e-6 * of_packages_ + (of_gpus ? *of_gpus - *gpus_at_start_ : 0);
}

Json Telemetry::gpus() const
{
    if (!nvml_->missing.empty()) return {{"missing", nvml_->missing}};
    Json list = Json::array();
    for (const GpuHandle gpu : nvml_->gpus) {
        std::array<char, 96> name{};
        nvml_->call("nvmlDeviceGetName", gpu, name.data(), static_cast<unsigned>(name.size()));
        unsigned long long bits = 0;
        const bool known = nvml_->call("nvmlDeviceGetCurrentClocksThrottleReasons", gpu, &bits);
        list.push_back({{"name", name.data()},
                        {"watts", or_null(nvml_->number<unsigned>(1e-3, "nvmlDeviceGetPowerUsage", gpu))},
                        {"sm_megahertz", or_null(nvml_->number<unsigned>(1, "nvmlDeviceGetClockInfo", gpu, sm_clock))},
                        {"throttled", known ? Json(words(bits)) : Json()}});
    }
    return list;
}

}  // namespace mandelmarch::bench
