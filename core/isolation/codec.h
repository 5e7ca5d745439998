// SPDX-License-Identifier: Apache-2.0
// Serialization of the backend interface's structures. The structured bindings below list all members of a structure,
// so that a member missing here is a compile error.
#pragma once

#include "core/isolation/message.h"
#include "core/render/backend.h"

namespace mandelmarch::isolation {

// transfer() writes or reads all members of a structure. `Archive` is a Serializer, for a const structure, or a
// Deserializer.
template <class Archive, class SceneOrConst>
requires std::is_same_v<std::remove_const_t<SceneOrConst>, Scene>
void transfer(Archive& archive, SceneOrConst& scene)
{
    auto& [fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
           brightness, image_file, conservative, smooth, centred, projection, sun, look, limits, crop_window] = scene;
    auto& [step_factor, root_share, tried] = limits;
    auto& [left, bottom, whole_width, whole_height] = crop_window;
    archive(fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
            brightness, image_file, conservative, smooth, centred, projection, sun, look, step_factor, root_share,
            tried, left, bottom, whole_width, whole_height);
}

template <class Archive, class DeviceOrConst>
requires std::is_same_v<std::remove_const_t<DeviceOrConst>, Device>
void transfer(Archive& archive, DeviceOrConst& device)
{
    auto& [name, vendor, driver, is_gpu] = device;
    archive(name, vendor, driver, is_gpu);
}

template <class Archive, class ResourcesOrConst>
requires std::is_same_v<std::remove_const_t<ResourcesOrConst>, KernelResources>
void transfer(Archive& archive, ResourcesOrConst& resources)
{
    auto& [kernel, registers, local_bytes] = resources;
    archive(kernel, registers, local_bytes);
}

template <class Archive, class ReportOrConst>
requires std::is_same_v<std::remove_const_t<ReportOrConst>, RenderStats>
void transfer(Archive& archive, ReportOrConst& report)
{
    auto& [backend, device, precision, mode, threads, simd_width, instruction_set, step_factor, unsettled, timings,
           work, kernels] = report;
    archive(backend);
    transfer(archive, device);
    archive(precision, mode, threads, simd_width, instruction_set, step_factor, unsettled, timings, work, kernels);
}

// Requests of a program to a device process. Each comment lists the arguments, then after the arrow the results in the
// response.
enum class Request : int {
    list,     // -> the reason why no device is available, or ""; the devices
    create,   // renderer number, options -> no results
    render,   // renderer number, image's layers, first row and rows, scene; shared memory if it is new -> RenderStats
    release,  // renderer number; has no response
    cancel,   // cancels the render in progress, if any; has no response
    peak      // options -> whether the peak is known; operations per second
};

// Kinds of responses of a device process. Any number of `progress` messages may precede the final response.
enum class Response : int { progress, done, error, input_error, unavailable, hung, no_memory, cancelled };

}  // namespace mandelmarch::isolation
