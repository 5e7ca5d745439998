// SPDX-License-Identifier: Apache-2.0
// Serialization of the backend interface's structures. Structured bindings make the compilation fail if a new member is
// missing here.
#pragma once

#include "core/isolation/message.h"
#include "core/render/backend.h"

namespace mandelmarch::isolation {

// `Archive` is a Writer, with a const value, or a Reader.
template <class Archive, class SceneOrConst>
requires std::is_same_v<std::remove_const_t<SceneOrConst>, Scene>
void transfer(Archive& archive, SceneOrConst& scene)
{
    auto& [fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
           brightness, image_file, conservative, smooth, centred, projection, sun, limits, crop_window] = scene;
    auto& [step_factor, root_share] = limits;
    auto& [left, bottom, whole_width, whole_height] = crop_window;
    archive(fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
            brightness, image_file, conservative, smooth, centred, projection, sun, step_factor, root_share, left,
            bottom, whole_width, whole_height);
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
    auto& [backend, device, precision, mode, threads, pack, instruction_set, step_factor, unsettled, timings, work,
           kernels] = report;
    archive(backend);
    transfer(archive, device);
    archive(precision, mode, threads, pack, instruction_set, step_factor, unsettled, timings, work, kernels);
}

// Requests of a program to a device process: arguments -> response.
enum class Request : int {
    list,     // -> reason why no device is available, or ""; the devices
    create,   // renderer number, options ->
    render,   // renderer number, whether the image has values, scene, shared memory of the image -> report
    release,  // renderer number; no response
    cancel,   // cancels the render in progress, if any; no response
    peak      // options -> whether a peak exists; operations per second
};

// Responses of a device process. Any number of progress messages may precede the final one.
enum class Answer : int { progress, done, error, input_error, unavailable, hung, no_memory, cancelled };

}  // namespace mandelmarch::isolation
