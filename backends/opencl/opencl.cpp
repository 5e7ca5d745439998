// SPDX-License-Identifier: Apache-2.0
#include "backends/opencl/opencl.h"

#include <fmt/format.h>

#include <cstdlib>

#include "backends/opencl/peak.h"
#include "backends/opencl/renderer.h"
#include "core/base/files.h"

namespace mandelmarch {
namespace {

class OpenclBackend : public Backend {
public:
    std::string_view name() const override { return "opencl"; }
    BackendInfo info() const override
    {
        return {.has_driver = true,
                .simd_width = true,
                .band = true,
                .block_size = true,
                .variables = {"POCL_MAX_PTHREAD_COUNT", "POCL_DEVICES", "POCL_AFFINITY", "OCL_ICD_VENDORS"},
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }

    // Each file in the vendors folder contains the name of a driver's library.
    std::vector<InstalledDriver> installed_drivers() const override
    {
        std::vector<InstalledDriver> found;
        const char* vendors = std::getenv("OCL_ICD_VENDORS");
        for (const std::string& path : files_in(vendors != nullptr ? vendors : "/etc/OpenCL/vendors")) {
            found.push_back({"opencl", path, first_line(path), ""});
        }
        found.push_back({"loader", "libOpenCL.so.1", "libOpenCL.so.1", ""});
        return found;
    }

    std::optional<std::string> unavailable() const override
    {
        if (!opencl::all_devices().empty()) return std::nullopt;
        return "no OpenCL device (is a driver installed, pocl-opencl-icd for the CPU, say?)";
    }

    std::vector<Device> devices() const override
    {
        std::vector<Device> devices;
        for (const cl::Device& device : opencl::all_devices()) devices.push_back(opencl::description(device));
        return devices;
    }

    std::unique_ptr<Renderer> create(const RendererOptions& options) const override
    {
        return opencl::make_renderer(device_of(options), options);
    }

    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        return opencl::multiply_add_peak(device_of(options), options);
    }

private:
    cl::Device device_of(const RendererOptions& options) const
    {
        const auto devices = opencl::all_devices();
        if (devices.empty()) throw Unavailable("backend opencl: " + *unavailable());
        const auto index = static_cast<std::size_t>(options.device);
        if (index >= devices.size()) {
            throw Unavailable(fmt::format("backend opencl: there is no device {}, only {} of them, from 0",
                                          options.device, devices.size()));
        }
        return devices[index];
    }
};

}  // namespace

std::unique_ptr<Backend> make_opencl_backend() { return std::make_unique<OpenclBackend>(); }

}  // namespace mandelmarch
