// SPDX-License-Identifier: Apache-2.0
// The Vulkan backend: the kernel as SPIR-V compute shaders, on GPUs, and on CPUs through lavapipe.
#include <fstream>
#include <nlohmann/json.hpp>

#include "backends/vulkan/instance.h"
#include "backends/vulkan/peak.h"
#include "backends/vulkan/renderer.h"
#include "core/base/files.h"

namespace mandelmarch {
namespace {

class VulkanBackend : public Backend {
public:
    std::string_view name() const override { return "vulkan"; }
    BackendInfo info() const override
    {
        return {.has_driver = true,
                .band = true,
                .variables = {"VK_ICD_FILENAMES", "VK_DRIVER_FILES", "LP_NUM_THREADS", "LP_NATIVE_VECTOR_WIDTH"},
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }

    // Reads the manifests of drivers in the folders in which the Vulkan loader searches.
    std::vector<InstalledDriver> installed_drivers() const override
    {
        std::vector<InstalledDriver> found;
        for (const char* folder : {"/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"}) {
            for (const std::string& path : files_in(folder)) {
                std::ifstream file(path);
                const auto manifest = nlohmann::json::parse(file, nullptr, false);
                if (!manifest.is_object() || !manifest.contains("ICD")) continue;
                const auto text = [&](const char* key) {
                    const auto value = manifest["ICD"].find(key);
                    return value != manifest["ICD"].end() && value->is_string() ? value->get<std::string>() : "";
                };
                found.push_back({"vulkan", path, text("library_path"), text("api_version")});
            }
        }
        found.push_back({"loader", "libvulkan.so.1", "libvulkan.so.1", ""});
        return found;
    }

    std::optional<std::string> unavailable() const override
    {
        try {
            const vulkan::Instance instance;
            return std::nullopt;
        } catch (const Unavailable& reason) {
            return reason.what();
        }
    }

    std::vector<Device> devices() const override
    {
        std::vector<Device> devices;
        try {
            const vulkan::Instance instance;
            for (const auto& physical : instance.devices()) devices.push_back(vulkan::facts_of(physical).device);
        } catch (const Error&) {
            devices.clear();  // unavailable() returns the reason
        }
        return devices;
    }

    std::unique_ptr<Renderer> create(const RendererOptions& options) const override
    {
        return vulkan::make_renderer(options);
    }

    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        return vulkan::multiply_add_peak(options);
    }
};

}  // namespace

std::unique_ptr<Backend> make_vulkan_backend() { return std::make_unique<VulkanBackend>(); }

}  // namespace mandelmarch
