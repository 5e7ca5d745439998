// SPDX-License-Identifier: Apache-2.0
// A backend whose kernels are the scalar text in the loops of a programming model: what differs between such models.
// docs/add-a-backend.md, "A model that compiles C++".
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

// A device, opened.
struct Opened {
    Device device = {};
    int threads = 1;
    std::string instruction_set = "scalar";
    std::int64_t pixels_per_band = 1 << 18;
    // Threads march several pixels each, of a fractal whose lanes would wait long: where pixels_per_band is known to be
    // waves_of_band of the threads that the device holds.
    bool lanes_refill = false;
    int peak_threads = 1 << 7;  // that keep it busy in multiply-adds; a multiple of block_threads
    std::string note = {};      // said where a renderer is made: that it is not what one would expect
};

// The kernels: mandelmarch_job_kernels (cmake/JobKernels.cmake) makes both functions, in the model's namespace.
struct Kernels {
    Launch (*drawing)(std::string_view fractal, Precision precision, Mode mode);  // nullptr: it has no such fractal
    Chains (*chains)(Precision precision);
};

class Model {
public:
    virtual ~Model() = default;

    // As Backend's functions of these names are.
    virtual std::string_view name() const = 0;
    virtual Facts facts() const = 0;
    virtual std::optional<std::string> unavailable() const { return std::nullopt; }

    virtual Kernels kernels() const = 0;

    // How many devices there are; 0 where unavailable() says why.
    virtual int devices() const { return 1; }

    // Called once for each device. Seconds that it takes are Timings::context.
    virtual Opened open(int index) const = 0;

    // Calls `draw` in a thread whose device is that of the options, with as many threads as they ask for.
    virtual void run(const RendererOptions& options, const std::function<void()>& draw) const
    {
        static_cast<void>(options);
        draw();
    }
    // How many threads run() takes.
    virtual int threads(const RendererOptions& options, const Opened& opened) const
    {
        static_cast<void>(options);
        return opened.threads;
    }

    // Runs a launch to its end, in run(). Returns the seconds that it took, by the device's clock where it has one.
    virtual double seconds_of(const std::function<void()>& launch) const;

    // Makes a launch's kernels ready on the calling thread's device, before its first launch and in Timings::build.
    // Returns what the driver made of them, where it tells.
    virtual std::vector<KernelResources> build(Launch launch) const
    {
        static_cast<void>(launch);
        return {};
    }

    // Bytes that a device has free for kernels; nullopt where it is the host.
    virtual std::optional<std::size_t> free_memory(int index) const
    {
        static_cast<void>(index);
        return std::nullopt;
    }

    // Memory of the calling thread's device, as void*; nullptr where there is none left.
    virtual void* allocate(std::size_t bytes) const;
    virtual void release(void* address) const;
    virtual void upload(void* to, const void* from, std::size_t bytes) const;
    virtual void read_back(void* to, const void* from, std::size_t bytes) const;

    // Memory of the host that the device copies to at full speed; nullptr where there is none left.
    virtual void* allocate_staging(std::size_t bytes) const;
    virtual void release_staging(void* address) const;
};

// The backend of a model.
std::unique_ptr<Backend> backend_of(std::unique_ptr<Model> model);

}  // namespace mandelmarch::job
