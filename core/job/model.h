// SPDX-License-Identifier: Apache-2.0
// The interface of programming models that compile the scalar kernel in their loops. See docs/add-a-backend.md, "A
// model that compiles C++".
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/job/job.h"
#include "core/render/backend.h"

namespace mandelmarch::job {

// An opened device.
struct OpenedDevice {
    Device device = {};
    int threads = 1;
    std::string instruction_set = "scalar";
    std::int64_t pixels_per_band = 1 << 18;
    // Threads march several pixels each, if the fractal uses refill. Requires that pixels_per_band is waves_of_band
    // times the resident threads.
    bool refill_lanes = false;
    int peak_threads = 1 << 7;  // threads that keep it busy with multiply-adds; a multiple of block_threads
    std::string note = {};      // warning printed when a renderer is created on this device; may be empty
};

// The kernels. mandelmarch_job_kernels (cmake/JobKernels.cmake) generates both functions, in the model's namespace.
struct Kernels {
    DrawKernel (*drawing)(std::string_view fractal, Precision precision, Mode mode);  // nullptr: unknown fractal
    Chains (*chains)(Precision precision);
};

class Model {
public:
    virtual ~Model() = default;

    // As the functions of Backend with these names.
    virtual std::string_view name() const = 0;
    virtual BackendInfo info() const = 0;
    virtual std::optional<std::string> unavailable() const { return std::nullopt; }

    virtual Kernels kernels() const = 0;

    // Returns the number of devices; 0 if unavailable().
    virtual int devices() const { return 1; }

    // Called once per device; its duration is part of Timings::context.
    virtual OpenedDevice open(int index) const = 0;

    // Calls `draw` in a thread that uses the device, with the number of threads of the options.
    virtual void run(const RendererOptions& options, const std::function<void()>& draw) const
    {
        static_cast<void>(options);
        draw();
    }
    // Returns the number of threads that run() uses.
    virtual int threads(const RendererOptions& options, const OpenedDevice& opened) const
    {
        static_cast<void>(options);
        return opened.threads;
    }

    // Runs a launch to completion, inside run(). Returns its seconds, by the device's clock if it has one.
    virtual double seconds_of(const std::function<void()>& launch) const;

    // Prepares the kernels of a launch on the calling thread's device, before its first launch; its duration is part of
    // Timings::build. Returns the kernels' resources, if the driver reports them.
    virtual std::vector<KernelResources> build(DrawKernel launch) const
    {
        static_cast<void>(launch);
        return {};
    }

    // Returns the free memory of a device, in bytes; nullopt if the device is the host.
    virtual std::optional<std::size_t> free_memory(int index) const
    {
        static_cast<void>(index);
        return std::nullopt;
    }

    // Memory of the calling thread's device; allocate() returns nullptr if it is exhausted.
    virtual void* allocate(std::size_t bytes) const;
    virtual void release(void* address) const;
    virtual void upload(void* to, const void* from, std::size_t bytes) const;
    virtual void read_back(void* to, const void* from, std::size_t bytes) const;

    // Host memory that the device copies to at full speed; nullptr if it is exhausted.
    virtual void* allocate_staging(std::size_t bytes) const;
    virtual void release_staging(void* address) const;
};

// Returns a backend for a model, which it owns.
std::unique_ptr<Backend> backend_of(std::unique_ptr<Model> model);

}  // namespace mandelmarch::job
