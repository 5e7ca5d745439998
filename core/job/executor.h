// SPDX-License-Identifier: Apache-2.0
// Runs the schedule on a programming model's device.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/job/camera_table.h"
#include "core/job/model.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"

namespace mandelmarch::job {

// Runs `call` and adds its duration to `seconds`.
template <class Call>
void timed(double& seconds, const Call& call)
{
    const auto begin = Clock::now();
    call();
    seconds += seconds_since(begin);
}

// A buffer that grows and is reused between pictures. It must be used and destroyed inside Model::run().
template <auto take, auto give>
class GrowingBuffer {
public:
    explicit GrowingBuffer(const Model& model) : model_(model) {}
    ~GrowingBuffer()
    {
        if (address_ != nullptr) (model_.*give)(address_);
    }
    GrowingBuffer(const GrowingBuffer&) = delete;
    GrowingBuffer& operator=(const GrowingBuffer&) = delete;

    // Returns a buffer of at least `bytes` bytes. Throws Error if the memory is exhausted.
    void* of_size(std::size_t bytes)
    {
        if (bytes <= size_) return address_;
        if (address_ != nullptr) (model_.*give)(address_);
        size_ = 0;
        address_ = (model_.*take)(bytes);
        if (address_ == nullptr) {
            throw Error(fmt::format("{}: there are no {} bytes of memory free", model_.name(), bytes));
        }
        size_ = bytes;
        return address_;
    }
    std::size_t size() const { return size_; }

private:
    const Model& model_;
    void* address_ = nullptr;
    std::size_t size_ = 0;  // bytes
};

using DeviceMemory = GrowingBuffer<&Model::allocate, &Model::release>;
using Staging = GrowingBuffer<&Model::allocate_staging, &Model::release_staging>;

// The buffers of a renderer.
struct Memory {
    DeviceMemory reals, wholes, bytes, camera, job;
    Staging host_reals, host_wholes;

    explicit Memory(const Model& model)
        : reals(model), wholes(model), bytes(model), camera(model), job(model), host_reals(model), host_wholes(model)
    {
    }
    // Returns the bytes of the device buffers whose sizes depend on the band.
    std::size_t held() const { return reals.size() + wholes.size() + bytes.size(); }
};

template <class Real>
constexpr std::size_t pixel_bytes = real_planes * sizeof(Real) + whole_planes * sizeof(int);

// Renders bands of up to `pixels` pixels.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(const Model& model, const OpenedDevice& opened, Memory& memory, DrawKernel* launch, const Scene& scene,
                 const RendererOptions& options, std::int64_t pixels, bool bytes_alone, Timings& timings)
        : model_(model), opened_(opened), memory_(memory), timings_(timings), launch_(launch)
    {
        job_.scene = kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques);
        // The kernels are compiled with fixed values of `canonical` and `differences` (pixels.h). Only tetrahedron
        // normals (differences == 2) are an exception.
        if (job_.scene.canonical != (options.mode == Mode::fast) ||
            (job_.scene.differences != 2 &&
             job_.scene.differences != (options.mode == Mode::exact && std::is_same_v<Real, double>))) {
            throw Unavailable(
                fmt::format("backend {}: its kernels are not made for this scene's hit or normal", model.name()));
        }
        const std::vector<Real> table = camera_table(job_.scene);
        const std::size_t table_size = table.size() * sizeof(Real);
        void* camera = memory.camera.of_size(table_size);
        model_.upload(camera, table.data(), table_size);
        const auto most = static_cast<std::size_t>(pixels);
        job_.camera = static_cast<const Real*>(camera);
        job_.reals = static_cast<Real*>(memory.reals.of_size(most * real_planes * sizeof(Real)));
        job_.wholes = static_cast<int*>(memory.wholes.of_size(most * whole_planes * sizeof(int)));
        job_.bytes = bytes_alone ? static_cast<unsigned char*>(memory.bytes.of_size(3 * most)) : nullptr;
        job_on_device_ = memory.job.of_size(sizeof(job_));
    }

    // The renderer's Limits have no limit of loop iterations, so the entry is always Entry::draw.
    void run(Entry, const Band& band, int) override
    {
        job_.first_row = band.first_row;
        job_.rows = band.rows;
        job_.pixels_of_thread = pixels_of_thread(std::int64_t{job_.scene.width} * band.rows);
        timed(timings_.upload, [&] { model_.upload(job_on_device_, &job_, sizeof(job_)); });
        double by_device = 0;
        double by_host = 0;
        timed(by_host,
              [&] { by_device = model_.seconds_of([&] { launch_(job_on_device_, job_.scene.width, band.rows); }); });
        timings_.ran(by_host, by_device);
    }

    bool marching(const Band&) override { return false; }

    void read_back(const Band& band, Image& image) override
    {
        const auto width = static_cast<std::size_t>(image.width());
        const std::size_t pixels = width * static_cast<std::size_t>(band.rows);
        timed(timings_.readback, [&] {
            if (job_.bytes != nullptr) {
                unsigned char* to = image.row_bytes(band.first_row);
                model_.read_back(to, job_.bytes, 3 * pixels);
                return;
            }
            const std::size_t reals_size = pixels * real_planes * sizeof(Real);
            const std::size_t wholes_size = pixels * whole_planes * sizeof(int);
            auto* reals = static_cast<Real*>(memory_.host_reals.of_size(reals_size));
            auto* wholes = static_cast<int*>(memory_.host_wholes.of_size(wholes_size));
            model_.read_back(reals, job_.reals, reals_size);
            model_.read_back(wholes, job_.wholes, wholes_size);
            const Planes<Real> planes = planes_of(reals, wholes, pixels, width);
            image.store(planes, 0, band.first_row, image.width(), band.rows);
            add_work(work_, planes, image.width(), band.rows);
        });
    }

    const Work& work() const { return work_; }

private:
    // Returns the number of pixels that a thread marches one after the other. If threads march more pixels, fewer lanes
    // of a warp are idle while the warp's last rays march. But enough threads must remain to fill the device twice.
    int pixels_of_thread(std::int64_t pixels) const
    {
        constexpr std::int64_t most = 8;
        const std::int64_t waves_left = waves_of_band / most;
        const std::int64_t waves = waves_of_band * pixels / opened_.pixels_per_band;
        return opened_.refill_lanes ? static_cast<int>(std::clamp<std::int64_t>(waves / waves_left, 1, most)) : 1;
    }

    const Model& model_;
    const OpenedDevice& opened_;
    Memory& memory_;
    Timings& timings_;
    DrawKernel* launch_;
    KernelArguments<KernelScene<Real>, Real> job_{};
    void* job_on_device_ = nullptr;
    Work work_;
};

}  // namespace mandelmarch::job
