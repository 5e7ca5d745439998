// SPDX-License-Identifier: Apache-2.0
#include "bench/machine/nvml.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <array>
#include <memory>
#include <utility>

namespace mandelmarch::bench {
namespace {

// Declarations from NVML's API reference, so that its header is not needed to build.
using Device = void*;
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

GpuState state_of(const Library& nvml, Device device)
{
    GpuState state;
    std::array<char, 96> name{};
    if (nvml.call("nvmlDeviceGetName", device, name.data(), static_cast<unsigned>(name.size())))
        state.name = name.data();
    const auto whole = [](bool told, unsigned value, double unit) {
        return told ? std::optional(unit * value) : std::nullopt;
    };
    unsigned value = 0;
    state.watts = whole(nvml.call("nvmlDeviceGetPowerUsage", device, &value), value, 1e-3);
    state.celsius = whole(nvml.call("nvmlDeviceGetTemperature", device, gpu_temperature, &value), value, 1);
    state.sm = whole(nvml.call("nvmlDeviceGetClockInfo", device, sm_clock, &value), value, 1);
    state.most_sm = whole(nvml.call("nvmlDeviceGetMaxClockInfo", device, sm_clock, &value), value, 1);
    state.memory = whole(nvml.call("nvmlDeviceGetClockInfo", device, memory_clock, &value), value, 1);
    unsigned long long large = 0;
    if (nvml.call("nvmlDeviceGetTotalEnergyConsumption", device, &large))
        state.joules = 1e-3 * static_cast<double>(large);
    if (nvml.call("nvmlDeviceGetCurrentClocksThrottleReasons", device, &large)) state.throttled = words(large);
    return state;
}

}  // namespace

GpuStates gpu_states(const std::string& library)
{
    const Library nvml(library);
    if (!nvml) return {.gpus = {}, .missing = library + " is not installed"};
    if (!nvml.call("nvmlInit_v2")) return {.gpus = {}, .missing = library + " finds no driver"};
    GpuStates found;
    unsigned count = 0;
    nvml.call("nvmlDeviceGetCount_v2", &count);
    for (unsigned i = 0; i < count; ++i) {
        Device device = nullptr;
        if (nvml.call("nvmlDeviceGetHandleByIndex_v2", i, &device)) found.gpus.push_back(state_of(nvml, device));
    }
    nvml.call("nvmlShutdown");
    if (found.gpus.empty()) found.missing = library + " finds no GPU";
    return found;
}

}  // namespace mandelmarch::bench
