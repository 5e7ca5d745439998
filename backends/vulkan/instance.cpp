// SPDX-License-Identifier: Apache-2.0
#include "backends/vulkan/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/os/cores.h"
#include "core/os/memory.h"
#include "core/text/text.h"

namespace mandelmarch::vulkan {
namespace {

// Converts a driver's text. A text that fills its array has no final NUL.
template <class Array>
std::string text_of(const Array& text)
{
    return printable({text.data(), strnlen(text.data(), text.size())});
}

vk::raii::Context open_loader()
{
    try {
        return {};
    } catch (const std::exception&) {
        refuse_shortage("backend vulkan: opening the loader");
        throw Unavailable("no Vulkan loader is installed (libvulkan.so.1)");
    }
}

vk::raii::Instance open_instance(const vk::raii::Context& context)
{
    try {
        limit_driver_threads("LP_NUM_THREADS");
        if (context.enumerateInstanceVersion() < VK_API_VERSION_1_1) {
            throw Unavailable("the Vulkan loader supports only version 1.0, expected 1.1");
        }
        const vk::ApplicationInfo application("mandelmarch", 0, nullptr, 0, VK_API_VERSION_1_1);
        return {context, vk::InstanceCreateInfo({}, &application)};
    } catch (const vk::IncompatibleDriverError&) {
        refuse_shortage("backend vulkan: opening drivers");
        throw Unavailable("no Vulkan driver is installed");
    } catch (const vk::SystemError& error) {
        throw Unavailable("no Vulkan instance: " + describe(error));
    }
}

int rank_of(vk::PhysicalDeviceType type)
{
    switch (type) {
        case vk::PhysicalDeviceType::eDiscreteGpu: return 0;
        case vk::PhysicalDeviceType::eIntegratedGpu: return 1;
        case vk::PhysicalDeviceType::eVirtualGpu: return 2;
        case vk::PhysicalDeviceType::eCpu: return 4;
        default: return 3;
    }
}

// Returns the vendor of an identifier assigned by PCI's registry or by Khronos.
std::string vendor_name(std::uint32_t id)
{
    switch (id) {
        case 0x1002: return "AMD";
        case 0x1010: return "Imagination";
        case 0x106b: return "Apple";
        case 0x10de: return "NVIDIA";
        case 0x13b5: return "Arm";
        case 0x14e4: return "Broadcom";
        case 0x1ae0: return "Google";
        case 0x5143: return "Qualcomm";
        case 0x8086: return "Intel";
        case VK_VENDOR_ID_MESA: return "Mesa";
        default: return fmt::format("vendor {:#x}", id);
    }
}

bool has_extension(const vk::raii::PhysicalDevice& physical, std::string_view name)
{
    return std::ranges::any_of(physical.enumerateDeviceExtensionProperties(),
                               [&](const auto& extension) { return name == extension.extensionName.data(); });
}

}  // namespace

Instance::Instance() : context_(open_loader()), instance_(open_instance(context_))
{
    try {
        devices_ = vk::raii::PhysicalDevices(instance_);
    } catch (const vk::SystemError& error) {
        throw Unavailable("no Vulkan device: " + describe(error));
    }
    if (devices_.empty()) throw Unavailable("no Vulkan device was found");
    std::ranges::stable_sort(devices_, {},
                             [](const auto& physical) { return rank_of(physical.getProperties().deviceType); });
}

DeviceInfo facts_of(const vk::raii::PhysicalDevice& physical)
{
    DeviceInfo info;
    info.properties = physical.getProperties();
    const auto& properties = info.properties;
    info.has_double = physical.getFeatures().shaderFloat64 != 0;
    info.shares_memory = properties.deviceType == vk::PhysicalDeviceType::eCpu ||
                         properties.deviceType == vk::PhysicalDeviceType::eIntegratedGpu;
    info.device = {.name = text_of(properties.deviceName),
                   .vendor = vendor_name(properties.vendorID),
                   .driver = fmt::format("driver {:#x}", properties.driverVersion),
                   .is_gpu = rank_of(properties.deviceType) < 3};
    if (properties.apiVersion < VK_API_VERSION_1_1) return info;
    info.largest_allocation =
        physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceMaintenance3Properties>()
            .get<vk::PhysicalDeviceMaintenance3Properties>()
            .maxMemoryAllocationSize;
    if (has_extension(physical, VK_NV_SHADER_SM_BUILTINS_EXTENSION_NAME)) {
        const auto held =
            physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceShaderSMBuiltinsPropertiesNV>()
                .get<vk::PhysicalDeviceShaderSMBuiltinsPropertiesNV>();
        constexpr std::int64_t warp = 32;
        info.most_invocations = warp * held.shaderSMCount * held.shaderWarpsPerSM;
    }
    if (properties.apiVersion >= VK_API_VERSION_1_2 ||
        has_extension(physical, VK_KHR_DRIVER_PROPERTIES_EXTENSION_NAME)) {
        const auto driver = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>()
                                .get<vk::PhysicalDeviceDriverProperties>();
        info.device.driver = fmt::format("{} {}", text_of(driver.driverName), text_of(driver.driverInfo));
        info.counts_loops = driver.driverID == vk::DriverId::eMesaLlvmpipe;
    }
    return info;
}

std::string describe(const vk::SystemError& error)
{
    switch (static_cast<vk::Result>(error.code().value())) {
        case vk::Result::eErrorDeviceLost: return "device lost";
        case vk::Result::eErrorOutOfDeviceMemory: return "out of device memory";
        case vk::Result::eErrorOutOfHostMemory: return "out of host memory";
        case vk::Result::eErrorInitializationFailed: return "initialisation failed";
        default: return error.what();
    }
}

}  // namespace mandelmarch::vulkan
