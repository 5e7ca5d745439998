// SPDX-License-Identifier: Apache-2.0
// The interface of programming models that compile C++ and run the scalar kernel in their own loops. A loop on a CPU
// needs core/models/host.h only. Other models write a class and their factory:
//     class Mine : public job::Model { ... name(), info(), kernels(), open(), allocate(), upload() ... };
//     std::unique_ptr<Backend> make_mine_backend() { return job::backend_of(std::make_unique<Mine>()); }
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/models/host.h"
#include "core/models/task.h"
#include "core/render/backend.h"

namespace mandelmarch::job {

// An opened device.
struct OpenedDevice {
    Device device = {};
    int threads = 1;
    std::string instruction_set = "scalar";
    std::int64_t pixels_per_band = 1 << 18;
    int multiprocessors = 0;                   // number of a GPU's multiprocessors; 0: unknown
    int resident_warps = job::resident_warps;  // number of warps that render at once on a multiprocessor
    // True for loops on a CPU that use cells.h, false for threads of a GPU that use threads.h or warps.h.
    bool in_cells = false;
    int peak_threads = 1 << 7;  // threads that measure the multiply-add peak; a multiple of block_threads
    std::string note = {};      // warning that is printed when a renderer uses this device; may be empty
    // Locked while a job's kernels run: they may have one job and one queue for each device.
    std::shared_ptr<std::mutex> turn = std::make_shared<std::mutex>();
};

// Functions that find kernels by name and return nullptr for an unknown name. cmake/Models.cmake generates both, in
// the model's namespace.
struct Kernels {
    DrawKernel* (*drawing)(std::string_view variant);  // by variant_name()
    Chains* (*chains)(std::string_view precision);     // by name_of()
    // Drawing kernels take jobs from the host, and can render several at the same time.
    bool take_job = false;
};

// A programming model. The functions below select() are called while a selection lives.
class Model {
public:
    virtual ~Model() = default;

    // Functions like those of Backend with the same names.
    virtual std::string_view name() const = 0;
    virtual BackendInfo info() const = 0;
    virtual std::optional<std::string> unavailable() const { return std::nullopt; }

    virtual Kernels kernels() const = 0;

    // Returns the number of devices. Not called if unavailable() gives a reason.
    virtual int devices() const { return 1; }

    // Opens a device. Called once per device. Timings::context includes its duration.
    virtual OpenedDevice open(int index) const = 0;

    // Selects the options' device and number of threads for the calling thread, until the returned object is destroyed.
    virtual Selection select(const RendererOptions&) const { return nullptr; }
    // Returns the number of threads that select() selects.
    virtual int threads(const RendererOptions&, const OpenedDevice& opened) const { return opened.threads; }

    // Calls `launch` and waits until the device has finished. Returns the seconds, measured by the
    // device's clock if it has one.
    virtual double seconds_of(const std::function<void()>& launch) const;

    // Loads or compiles drawing kernels on the calling thread's device. Called before their first launch.
    // Timings::build includes its duration. Returns the resources of the kernels; empty if the driver does not report
    // them.
    virtual std::vector<KernelResources> build(DrawKernel*) const { return {}; }

    // Returns the free memory of a device, in bytes; nullopt if the device is the host.
    virtual std::optional<std::size_t> free_memory(int) const { return std::nullopt; }

    // Memory of the calling thread's device. allocate() returns nullptr if this memory is exhausted.
    virtual void* allocate(std::size_t bytes) const;
    virtual void release(void* address) const;
    virtual void upload(void* to, const void* from, std::size_t bytes) const;
    virtual void read_back(void* to, const void* from, std::size_t bytes) const;

    // Host memory to which the device copies at full speed. allocate_staging() returns nullptr if this memory is
    // exhausted.
    virtual void* allocate_staging(std::size_t bytes) const;
    virtual void release_staging(void* address) const;
    // Like Renderer::lock_memory().
    virtual std::shared_ptr<void> lock_memory(std::span<std::uint8_t>) const { return nullptr; }
};

// Returns a backend that uses the model, and owns it.
std::unique_ptr<Backend> backend_of(std::unique_ptr<Model> model);

}  // namespace mandelmarch::job
