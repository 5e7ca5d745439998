// SPDX-License-Identifier: Apache-2.0
// The backend interface's structures as messages. Each is taken apart by a structured binding, so that a new member
// that is forgotten here does not compile.
#pragma once

#include "core/isolation/message.h"
#include "core/render/backend.h"

namespace mandelmarch::isolation {

// `Archive` is a Writer, and the value const, or a Reader.
template <class Archive, class SceneOrConst>
requires std::is_same_v<std::remove_const_t<SceneOrConst>, Scene>
void transfer(Archive& archive, SceneOrConst& scene)
{
    auto& [fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
           brightness, image_file, conservative, smooth, centred, projection, sun, limits, part] = scene;
    auto& [stride, root_share] = limits;
    auto& [left, bottom, whole_width, whole_height] = part;
    archive(fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
            brightness, image_file, conservative, smooth, centred, projection, sun, stride, root_share, left, bottom,
            whole_width, whole_height);
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
requires std::is_same_v<std::remove_const_t<ReportOrConst>, RenderReport>
void transfer(Archive& archive, ReportOrConst& report)
{
    auto& [backend, device, precision, mode, threads, pack, instruction_set, stride, unsettled, timings, work,
           kernels] = report;
    archive(backend);
    transfer(archive, device);
    archive(precision, mode, threads, pack, instruction_set, stride, unsettled, timings, work, kernels);
}

// What a program asks of a device's process.
enum class Request : int {
    list,     // -> why there is no device, or an empty text; the devices
    create,   // a renderer's number, its options ->
    render,   // its number, whether the image has values, the scene; with it the image's memory -> the report
    release,  // its number; nothing is answered
    cancel,   // nothing is answered: what is being drawn is, if it still is
    peak      // options -> whether there is a number; operations per second
};

// What it answers. Progress comes any number of times before one of the others.
enum class Answer : int { progress, done, error, input_error, unavailable, hung, no_memory, cancelled };

}  // namespace mandelmarch::isolation
