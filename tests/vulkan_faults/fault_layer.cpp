// SPDX-License-Identifier: Apache-2.0
// A Vulkan layer that makes a good driver fail. MANDELMARCH_FAULT_AFTER: the number of calls that succeed before the
// fault. MANDELMARCH_FAULT: the fault, one of
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
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <vector>

#include "tests/drivers/driver_faults.h"
#include "tests/vulkan_faults/wrong_arithmetic.h"

namespace {

using mandelmarch::Rewritten;
using mandelmarch::without_division;
using mandelmarch::drivers::driver_faults;

// Functions of the next layer, for the instance and device created last. One set is enough, because all instances and
// devices of a program have the same driver.
struct Next {
    PFN_vkGetInstanceProcAddr instance_proc = nullptr;
    PFN_vkGetDeviceProcAddr device_proc = nullptr;
    PFN_vkCreateDevice create_device = nullptr;
    PFN_vkGetPhysicalDeviceFeatures get_features = nullptr;
    PFN_vkGetPhysicalDeviceProperties get_properties = nullptr;
    PFN_vkGetPhysicalDeviceProperties2 get_properties2 = nullptr;
    PFN_vkAllocateMemory allocate_memory = nullptr;
    PFN_vkQueueSubmit queue_submit = nullptr;
    PFN_vkWaitForFences wait_for_fences = nullptr;
    PFN_vkCreateFence create_fence = nullptr;
    PFN_vkCreateShaderModule create_shader_module = nullptr;
    PFN_vkMapMemory map_memory = nullptr;
    PFN_vkDestroyDevice destroy_device = nullptr;
    int calls = 0;  // of the function that the fault affects
};
Next next;

bool wanted(std::string_view fault)
{
    const char* name = std::getenv("MANDELMARCH_FAULT");
    return name != nullptr && name == fault;
}

// Counts the calls of the function that the fault affects. Returns true if this call must fail.
bool strikes(std::string_view fault)
{
    if (!wanted(fault)) return false;
    const char* after = std::getenv("MANDELMARCH_FAULT_AFTER");
    return next.calls++ >= (after == nullptr ? 0 : std::atoi(after));
}

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
    const auto ask = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(next.instance_proc(*instance, name));
    };
    ask(next.create_device, "vkCreateDevice");
    ask(next.get_features, "vkGetPhysicalDeviceFeatures");
    ask(next.get_properties, "vkGetPhysicalDeviceProperties");
    ask(next.get_properties2, "vkGetPhysicalDeviceProperties2");
    return result;
}

VkResult create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* create, const VkAllocationCallbacks* memory,
                       VkDevice* device)
{
    auto* link = link_of<VkLayerDeviceCreateInfo>(create, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
    next.device_proc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const VkResult result = next.create_device(physical, create, memory, device);
    if (result != VK_SUCCESS) return result;
    const auto ask = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(next.device_proc(*device, name));
    };
    ask(next.allocate_memory, "vkAllocateMemory");
    ask(next.queue_submit, "vkQueueSubmit");
    ask(next.wait_for_fences, "vkWaitForFences");
    ask(next.create_fence, "vkCreateFence");
    ask(next.create_shader_module, "vkCreateShaderModule");
    ask(next.map_memory, "vkMapMemory");
    ask(next.destroy_device, "vkDestroyDevice");
    return result;
}

void get_features(VkPhysicalDevice physical, VkPhysicalDeviceFeatures* features)
{
    next.get_features(physical, features);
    if (wanted("no_double")) features->shaderFloat64 = VK_FALSE;
}

void get_properties(VkPhysicalDevice physical, VkPhysicalDeviceProperties* properties)
{
    next.get_properties(physical, properties);
    if (wanted("discrete_gpu")) properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
    // Returns garbage: a name that fills its array without a terminating 0.
    if (!driver_faults("enumeration")) return;
    for (std::size_t i = 0; i < sizeof properties->deviceName; ++i) {
        properties->deviceName[i] =
            mandelmarch::drivers::garbage_name[i % std::strlen(mandelmarch::drivers::garbage_name)];
    }
}

void get_properties2(VkPhysicalDevice physical, VkPhysicalDeviceProperties2* properties)
{
    next.get_properties2(physical, properties);
    for (auto* part = static_cast<VkBaseOutStructure*>(properties->pNext); part != nullptr; part = part->pNext) {
        if (wanted("unknown_driver") && part->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES) {
            reinterpret_cast<VkPhysicalDeviceDriverProperties*>(part)->driverID = VkDriverId{};
        }
    }
}

VkResult allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks* callbacks,
                         VkDeviceMemory* memory)
{
    if (strikes("memory")) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    return next.allocate_memory(device, info, callbacks, memory);
}

VkResult queue_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* infos, VkFence fence)
{
    // If the action is garbage, the submission does nothing and reports success.
    if (driver_faults("launch")) count = 0;
    if (strikes("lost")) return VK_ERROR_DEVICE_LOST;
    return next.queue_submit(queue, count, infos, fence);
}

VkResult wait_for_fences(VkDevice device, std::uint32_t count, const VkFence* fences, VkBool32 all,
                         std::uint64_t timeout)
{
    if (strikes("silent")) {
        std::this_thread::sleep_for(std::chrono::nanoseconds(timeout));
        return VK_TIMEOUT;
    }
    return next.wait_for_fences(device, count, fences, all, timeout);
}

VkResult create_fence(VkDevice device, const VkFenceCreateInfo* info, const VkAllocationCallbacks* memory,
                      VkFence* fence)
{
    VkFenceCreateInfo misused = *info;
    if (wanted("misuse")) misused.flags |= 0x40000000;
    return next.create_fence(device, &misused, memory, fence);
}

VkResult map_memory(VkDevice device, VkDeviceMemory memory, VkDeviceSize offset, VkDeviceSize size,
                    VkMemoryMapFlags flags, void** data)
{
    driver_faults("map");
    return next.map_memory(device, memory, offset, size, flags, data);
}

void destroy_device(VkDevice device, const VkAllocationCallbacks* callbacks)
{
    driver_faults("release");
    next.destroy_device(device, callbacks);
}

VkResult create_shader_module(VkDevice device, const VkShaderModuleCreateInfo* info,
                              const VkAllocationCallbacks* memory, VkShaderModule* module)
{
    VkShaderModuleCreateInfo changed = *info;
    std::vector<std::uint32_t> words(info->pCode, info->pCode + info->codeSize / 4);
    if (wanted("float_units")) words = Rewritten(words).off_by_a_unit();
    if (wanted("contraction")) words = Rewritten(words).contracted();
    if (wanted("float_division")) words = without_division(words, 32);
    if (wanted("double_division")) words = without_division(words, 64);
    if (driver_faults("build")) return VK_ERROR_INITIALIZATION_FAILED;
    changed.codeSize = 4 * words.size();
    changed.pCode = words.data();
    return next.create_shader_module(device, &changed, memory, module);
}

template <class Function>
PFN_vkVoidFunction plain(Function* function)
{
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction own(std::string_view name);

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

PFN_vkVoidFunction own(std::string_view name)
{
    static const std::map<std::string_view, PFN_vkVoidFunction> functions{
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
    const auto found = functions.find(name);
    return found == functions.end() ? nullptr : found->second;
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
