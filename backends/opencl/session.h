// SPDX-License-Identifier: Apache-2.0
// An opened device with its programs and buffers, and functions that wait for the device and read its clock.
#pragma once

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <vector>

#include "backends/opencl/device.h"
#include "core/text/environment.h"

namespace mandelmarch::opencl {

// A buffer that grows and is reused between pictures.
struct GrowingBuffer {
    cl::Buffer buffer;
    std::size_t size = 0;  // bytes

    const cl::Buffer& of_size(const cl::Context& context, cl_mem_flags flags, std::size_t bytes)
    {
        if (bytes <= size) return buffer;
        size = 0;
        buffer = {};  // released before the larger one is allocated
        buffer = cl::Buffer(context, flags, bytes);
        size = bytes;
        return buffer;
    }
};

// Host memory to which the device copies at full speed. It is the mapped memory of a buffer.
class Staging {
public:
    ~Staging() { give_back(); }
    Staging() = default;
    Staging(const Staging&) = delete;
    Staging& operator=(const Staging&) = delete;

    void* of_size(const cl::Context& context, const cl::CommandQueue& queue, std::size_t bytes)
    {
        if (bytes > pinned_.size) {
            give_back();
            queue_ = queue;
            const cl::Buffer& buffer = pinned_.of_size(context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, bytes);
            mapped_ = queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, bytes);
        }
        return mapped_;
    }

private:
    void give_back()
    {
        // Uses the C function, because a destructor must not throw.
        if (mapped_ != nullptr) clEnqueueUnmapMemObject(queue_(), pinned_.buffer(), mapped_, 0, nullptr, nullptr);
        mapped_ = nullptr;
    }

    GrowingBuffer pinned_;
    cl::CommandQueue queue_;
    void* mapped_ = nullptr;
};

struct Session {
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;
    std::map<std::string_view, cl::Program> programs;  // by fractal
    GrowingBuffer constants;
    GrowingBuffer reals;
    GrowingBuffer wholes;
    GrowingBuffer bytes;
    GrowingBuffer starts;
    GrowingBuffer cone_work;
    GrowingBuffer depths;
    Staging host_reals;
    Staging host_wholes;
    bool is_cpu = false;
    std::int64_t largest_buffer = 0;  // bytes
};

// Returns the source text of the program for a fractal, generated from kernel.cl (CMakeLists.txt); nullptr if there is
// none.
const std::string_view* program_text(std::string_view fractal);

// Returns the sum of the run times of kernels in seconds, by the device's clock; nullopt if the device has no clock.
inline std::optional<double> device_seconds(const std::vector<cl::Event>& kernels)
{
    double seconds = 0;
    for (const cl::Event& done : kernels) {
        cl_ulong begin = 0;
        cl_ulong end = 0;
        // Uses the C function, which does not throw, because a missing clock is not an error.
        const auto ask = [&](cl_profiling_info when, cl_ulong& time) {
            return clGetEventProfilingInfo(done(), when, sizeof(time), &time, nullptr) == CL_SUCCESS;
        };
        if (!ask(CL_PROFILING_COMMAND_START, begin) || !ask(CL_PROFILING_COMMAND_END, end) || end < begin) return {};
        seconds += 1e-9 * static_cast<double>(end - begin);
    }
    return seconds;
}

// Waits for the end of the events' commands. Throws DeviceHung if that takes longer than device_timeout(), cl::Error if
// a command fails.
inline void wait_for(const std::vector<cl::Event>& events, const char* doing)
{
    struct Signal {
        std::mutex mutex;
        std::condition_variable changed;
        bool ended = false;
        cl_int status = CL_QUEUED;  // negative: an error
    };
    // A separate thread waits, because clWaitForEvents() has no time limit. Event callbacks are not used, because
    // NVIDIA's driver calls them some 15 ms late on an H100. The thread may outlive this function.
    const auto signal = std::make_shared<Signal>();
    std::thread([waiting = events, signal]() mutable {
        std::vector<cl_event> waited;
        for (const cl::Event& event : waiting) waited.push_back(event());
        cl_int status = clWaitForEvents(static_cast<cl_uint>(waited.size()), waited.data());
        if (status == CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST) {
            for (const cl_event event : waited) {
                cl_int of_event = CL_COMPLETE;
                clGetEventInfo(event, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof(of_event), &of_event, nullptr);
                status = of_event < 0 ? of_event : status;
            }
        }
        waiting.clear();  // the driver may be gone after the signal
        const std::lock_guard lock(signal->mutex);
        signal->status = status;
        signal->ended = true;
        signal->changed.notify_all();
    }).detach();
    std::unique_lock lock(signal->mutex);
    const auto limit = std::chrono::duration<double>(device_timeout());
    if (!signal->changed.wait_for(lock, limit, [&] { return signal->ended; })) {
        throw DeviceHung(fmt::format("backend opencl: no answer within {} s while {} (MANDELMARCH_DEVICE_TIMEOUT)",
                                     limit.count(), doing));
    }
    if (signal->status < 0) throw cl::Error(signal->status, "the kernel");
}

}  // namespace mandelmarch::opencl
