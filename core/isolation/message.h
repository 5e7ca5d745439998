// SPDX-License-Identifier: Apache-2.0
// Messages between a program and its device processes. A message contains values one after the other, with the bytes
// that they have in memory. Both processes run the same executable, so layouts and addresses of constants agree.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "core/render/backend.h"
#include "core/text/error.h"

namespace mandelmarch::isolation {

class Serializer {
public:
    template <class... Values>
    explicit Serializer(const Values&... values)
    {
        (put(values), ...);
    }

    template <class... Values>
    void operator()(const Values&... values)
    {
        (put(values), ...);
    }

    const std::string& bytes() const { return bytes_; }

private:
    template <class Value>
    void put(const Value& value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void put(const std::string& text)
    {
        put(text.size());
        bytes_ += text;
    }
    template <class Value>
    void put(const std::vector<Value>& values)
    {
        put(values.size());
        for (const Value& value : values) transfer(*this, value);
    }

    std::string bytes_;
};

// Reads the values of a message in order. Throws Error if the message ends too early.
class Deserializer {
public:
    explicit Deserializer(std::string bytes) : bytes_(std::move(bytes)) {}

    template <class... Values>
    void operator()(Values&... values)
    {
        (take(values), ...);
    }

    template <class Value>
    Value take()
    {
        Value value{};
        take(value);
        return value;
    }

private:
    // Skips `size` bytes and returns their address.
    const char* advance(std::size_t size)
    {
        if (size > bytes_.size() - at_) throw Error("a message of a device's process is too short");
        at_ += size;
        return bytes_.data() + at_ - size;
    }

    template <class Value>
    void take(Value& value)
    {
        static_assert(std::is_trivially_copyable_v<Value>);
        std::memcpy(&value, advance(sizeof value), sizeof value);
    }
    void take(std::string& text)
    {
        const auto size = take<std::size_t>();
        text.assign(advance(size), size);
    }
    template <class Value>
    void take(std::vector<Value>& values)
    {
        values.clear();
        for (auto left = take<std::size_t>(); left > 0; --left) transfer(*this, values.emplace_back());
    }

    std::string bytes_;
    std::size_t at_ = 0;
};

// transfer() writes or reads all members of a structure of the interface of backends. `Archive` is a Serializer, for a
// const structure, or a Deserializer. The structured bindings list all members, so that a missing one does not compile.
template <class Archive, class SceneOrConst>
requires std::is_same_v<std::remove_const_t<SceneOrConst>, Scene>
void transfer(Archive& archive, SceneOrConst& scene)
{
    auto& [fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
           brightness, image_file, conservative, smooth, grainy, centred, projection, sky, look, limits, crop_window] =
        scene;
    auto& [step_factor, root_share, tried] = limits;
    auto& [left, bottom, whole_width, whole_height] = crop_window;
    archive(fractal, eye, target, up, field_of_view, width, height, detail, shape, iterations, escape, colouring,
            brightness, image_file, conservative, smooth, grainy, centred, projection, sky, look, step_factor,
            root_share, tried, left, bottom, whole_width, whole_height);
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
