// SPDX-License-Identifier: Apache-2.0
// A layer between the Vulkan loader and a good driver, which makes the driver fail (faults.h). The words are
//   memory           vkAllocateMemory returns VK_ERROR_OUT_OF_DEVICE_MEMORY
//   lost             vkQueueSubmit returns VK_ERROR_DEVICE_LOST
//   silent           vkWaitForFences never sees a signalled fence
//   no_double        no device has shaderFloat64
//   float_units      float division and square root are a unit off in the last place
//   contraction      sums of a float product are computed in double and rounded once
//   float_division   float division is far off: shaders compute a * b instead of a / b
//   double_division  the same for double division, which is also used to correct float division
//   unknown_driver   drivers do not report their name
//   discrete_gpu     every device reports that it is a discrete GPU with its own memory
//   misuse           a fence is created with invalid flags, which the validation layers must report
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <chrono>
#include <map>
#include <string_view>
#include <thread>
#include <vector>

#include "tests/drivers/faults.h"
#include "tests/drivers/wrong_arithmetic.h"

namespace {

using namespace mandelmarch::drivers;
using mandelmarch::Rewritten;

using Functions = std::map<std::string_view, PFN_vkVoidFunction>;

// Functions of the next layer, for the instance and device created last. One set is enough, because all instances and
// devices of a program have the same driver.
struct Next {
    PFN_vkGetInstanceProcAddr instance_proc = nullptr;
    PFN_vkGetDeviceProcAddr device_proc = nullptr;
    Functions functions;
};
Next next;

template <class Function>
Function real(std::string_view name)
{
    return reinterpret_cast<Function>(next.functions.at(name));
}

const Functions& own_functions();

// Returns the layer's entry in the chain that the loader passes to vkCreateInstance and vkCreateDevice.
template <class LayerInfo, class CreateInfo>
LayerInfo* link_of(const CreateInfo* create, VkStructureType type)
{
    auto* info = static_cast<const LayerInfo*>(create->pNext);
    while (info != nullptr && !(info->sType == type && info->function == VK_LAYER_LINK_INFO)) {
        info = static_cast<const LayerInfo*>(info->pNext);
    }
    return const_cast<LayerInfo*>(info);
}

VkResult create_instance(const VkInstanceCreateInfo* create, const VkAllocationCallbacks* memory, VkInstance* instance)
{
    auto* link = link_of<VkLayerInstanceCreateInfo>(create, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
    next.instance_proc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create_next = reinterpret_cast<PFN_vkCreateInstance>(next.instance_proc(nullptr, "vkCreateInstance"));
    const VkResult result = create_next(create, memory, instance);
    if (result != VK_SUCCESS) return result;
    // Queries the functions now, because a later query would return those of the first layer.
    for (const auto& [name, function] : own_functions()) {
        next.functions[name] = next.instance_proc(*instance, name.data());
    }
    return result;
}

VkResult create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* create, const VkAllocationCallbacks* memory,
                       VkDevice* device)
{
    auto* link = link_of<VkLayerDeviceCreateInfo>(create, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    next.device_proc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result = real<PFN_vkCreateDevice>("vkCreateDevice")(physical, create, memory, device);
    if (result != VK_SUCCESS) return result;
    for (auto& [name, function] : next.functions) {
        if (const auto of_device = next.device_proc(*device, name.data())) function = of_device;
    }
    return result;
}

void get_features(VkPhysicalDevice physical, VkPhysicalDeviceFeatures* features)
{
    real<PFN_vkGetPhysicalDeviceFeatures>("vkGetPhysicalDeviceFeatures")(physical, features);
    if (has_fault("no_double")) features->shaderFloat64 = VK_FALSE;
}

void get_properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties)
{
    real<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(physical, properties);
    if (has_fault("discrete_gpu")) properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    // Returns garbage: a name that fills its array without a terminating 0.
    if (!driver_faults("list")) return;
    for (std::size_t i = 0; i < sizeof properties->deviceName; ++i) {
        properties->deviceName[i] = garbage_name[i % garbage_name.size()];
    }
}

void get_properties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* properties)
{
    real<PFN_vkGetPhysicalDeviceProperties2>("vkGetPhysicalDeviceProperties2")(physical, properties);
    for (auto* part = static_cast<VkBaseOutStructure*>(properties->pNext); part != nullptr; part = part->pNext) {
        if (has_fault("unknown_driver") && part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceDriverProperties*>(part)->driverID = VkDriverId{};
        }
    }
}

VkResult allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                         VkDeviceMemory* memory)
{
    if (fails("memory")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return real<PFN_vkAllocateMemory>("vkAllocateMemory")(device, info, callbacks, memory);
}

VkResult queue_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence)
{
    driver_faults("launch");
    if (fails("lost")) return VK_ERROR_DEVICE_LOST;
    return real<PFN_vkQueueSubmit>("vkQueueSubmit")(queue, count, infos, fence);
}

VkResult wait_for_fences(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                         std::uint64_t timeout)
{
    if (fails("silent")) {
        std::this_thread::sleep_for(std::chrono::nanoseconds(timeout));
        return VK_TIMEOUT;
    }
    return real<PFN_vkWaitForFences>("vkWaitForFences")(device, count, fences, all, timeout);
}

VkResult create_fence(VkDevice device, const VkFenceCreateInfo* info, const VkAllocationCallbacks* memory,
                      VkFence* fence)
{
    VkFenceCreateInfo misused = *info;
    if (has_fault("misuse")) misused.flags |= 0x40000000;
    return real<PFN_vkCreateFence>("vkCreateFence")(device, &misused, memory, fence);
}

VkResult map_memory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                    VkMemoryMapFlags flags, void** data)
{
    driver_faults("map");
    return real<PFN_vkMapMemory>("vkMapMemory")(device, memory, offset, size, flags, data);
}

void destroy_device(VkDevice device, const VkAllocationCallbacks* callbacks)
{
    driver_faults("release");
    real<PFN_vkDestroyDevice>("vkDestroyDevice")(device, callbacks);
}

VkResult create_shader_module(VkDevice device, const VkShaderModuleCreateInfo* info,
                              const VkAllocationCallbacks* memory, VkShaderModule* module)
{
    VkShaderModuleCreateInfo changed = *info;
    std::vector<std::uint32_t> words(info->pCode, info->pCode + info->codeSize / 4);
    if (has_fault("float_units")) words = Rewritten(words).off_by_a_unit();
    if (has_fault("contraction")) words = Rewritten(words).contracted();
    if (has_fault("float_division")) words = Rewritten(words).without_division(32);
    if (has_fault("double_division")) words = Rewritten(words).without_division(64);
    if (driver_faults("build")) return VK_ERROR_INITIALIZATION_FAILED;
    changed.codeSize = 4 * words.size();
    changed.pCode = words.data();
    return real<PFN_vkCreateShaderModule>("vkCreateShaderModule")(device, &changed, memory, module);
}

template <class Function>
PFN_vkVoidFunction plain(Function* function)
{
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction own(std::string_view name)
{
    const auto found = own_functions().find(name);
    return found == own_functions().end() ? nullptr : found->second;
}

PFN_vkVoidFunction device_proc(VkDevice device, const char* name)
{
    if (const PFN_vkVoidFunction function = own(name)) return function;
    return next.device_proc == nullptr ? nullptr : next.device_proc(device, name);
}

PFN_vkVoidFunction instance_proc(VkInstance instance, const char* name)
{
    if (const PFN_vkVoidFunction function = own(name)) return function;
    return next.instance_proc == nullptr ? nullptr : next.instance_proc(instance, name);
}

const Functions& own_functions()
{
    static const Functions functions{
        {"vkGetInstanceProcAddr", plain(instance_proc)},
        {"vkGetDeviceProcAddr", plain(device_proc)},
        {"vkCreateInstance", plain(create_instance)},
        {"vkCreateDevice", plain(create_device)},
        {"vkGetPhysicalDeviceFeatures", plain(get_features)},
        {"vkGetPhysicalDeviceProperties", plain(get_properties)},
        {"vkGetPhysicalDeviceProperties2", plain(get_properties2)},
        {"vkAllocateMemory", plain(allocate_memory)},
        {"vkQueueSubmit", plain(queue_submit)},
        {"vkWaitForFences", plain(wait_for_fences)},
        {"vkCreateFence", plain(create_fence)},
        {"vkCreateShaderModule", plain(create_shader_module)},
        {"vkMapMemory", plain(map_memory)},
        {"vkDestroyDevice", plain(destroy_device)},
    };
    return functions;
}

}  // namespace

// Entry point for the loader.
extern "C" __attribute__((visibility("default"))) VkResult vkNegotiateLoaderLayerInterfaceVersion(
    VkNegotiateLayerInterface* interface)
{
    driver_faults("load");
    interface->loaderLayerInterfaceVersion = 2;
    interface->pfnGetInstanceProcAddr = instance_proc;
    interface->pfnGetDeviceProcAddr = device_proc;
    interface->pfnGetPhysicalDeviceProcAddr = nullptr;
    return VK_SUCCESS;
}
