// SPDX-License-Identifier: Apache-2.0
// Core's schedule on a model's device.
#pragma once

#include <fmt/format.h>

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

// Adds the seconds of a call.
template <class Call>
void timed(double& seconds, const Call& call)
{
    const auto begin = Clock::now();
    call();
    seconds += seconds_since(begin);
}

// Memory of the device that the calling thread uses. Throws Error where there is none left.
class DeviceMemory {
public:
    DeviceMemory(const Model& model, std::size_t bytes) : model_(model), address_(model.allocate(bytes))
    {
        if (address_ == nullptr) {
            throw Error(fmt::format("{}: the device has no {} bytes of memory free", model.name(), bytes));
        }
    }
    ~DeviceMemory() { model_.release(address_); }
    DeviceMemory(const DeviceMemory&) = delete;
    DeviceMemory& operator=(const DeviceMemory&) = delete;

    void* address() const { return address_; }

private:
    const Model& model_;
    void* address_;
};

template <class Real>
constexpr std::size_t pixel_bytes = real_planes * sizeof(Real) + whole_planes * sizeof(int);

// Draws bands of at most `pixels` pixels.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(const Model& model, Launch launch, const Scene& scene, const RendererOptions& options,
                 std::int64_t pixels, bool bytes_alone, Timings& timings)
        : model_(model),
          timings_(timings),
          launch_(launch),
          reals_on_device_(model, static_cast<std::size_t>(pixels) * real_planes * sizeof(Real)),
          wholes_on_device_(model, static_cast<std::size_t>(pixels) * whole_planes * sizeof(int)),
          job_on_device_(model, sizeof(job_))
    {
        if (bytes_alone) bytes_on_device_.emplace(model, 3 * static_cast<std::size_t>(pixels));
        job_.scene = kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques);
        // The kernels take these two as fixed (pixels.h), but for normals of a tetrahedron.
        if (job_.scene.canonical != (options.mode == Mode::fast) ||
            (job_.scene.differences != 2 &&
             job_.scene.differences != (options.mode == Mode::exact && std::is_same_v<Real, double>))) {
            throw Unavailable(
                fmt::format("backend {}: its kernels are not made for this scene's hit or normal", model.name()));
        }
        const std::vector<Real> table = camera_table(job_.scene);
        camera_on_device_.emplace(model, table.size() * sizeof(Real));
        model_.upload(camera_on_device_->address(), table.data(), table.size() * sizeof(Real));
        job_.camera = static_cast<const Real*>(camera_on_device_->address());
        job_.reals = static_cast<Real*>(reals_on_device_.address());
        job_.wholes = static_cast<int*>(wholes_on_device_.address());
        job_.bytes = bytes_alone ? static_cast<unsigned char*>(bytes_on_device_->address()) : nullptr;
    }

    // A whole pixel is asked for.
    void run(Entry, const Band& band, int) override
    {
        job_.first_row = band.first_row;
        job_.rows = band.rows;
        timed(timings_.upload, [&] { model_.upload(job_on_device_.address(), &job_, sizeof(job_)); });
        timed(timings_.kernel, [&] { launch_(job_on_device_.address(), job_.scene.width, band.rows); });
    }

    bool marching(const Band&) override { return false; }

    void read_back(const Band& band, Image& image) override
    {
        const auto width = static_cast<std::size_t>(image.width());
        const std::size_t pixels = width * static_cast<std::size_t>(band.rows);
        timed(timings_.readback, [&] {
            if (bytes_on_device_) {
                unsigned char* to = image.bytes().data() + 3 * width * static_cast<std::size_t>(band.first_row);
                model_.read_back(to, bytes_on_device_->address(), 3 * pixels);
                return;
            }
            reals_.resize(pixels * real_planes);
            wholes_.resize(pixels * whole_planes);
            model_.read_back(reals_.data(), reals_on_device_.address(), reals_.size() * sizeof(Real));
            model_.read_back(wholes_.data(), wholes_on_device_.address(), wholes_.size() * sizeof(int));
            const Planes<Real> planes = planes_of(reals_.data(), wholes_.data(), pixels, width);
            image.store(planes, 0, band.first_row, image.width(), band.rows);
            add_work(work_, planes, image.width(), band.rows);
        });
    }

    const Work& work() const { return work_; }

private:
    const Model& model_;
    Timings& timings_;
    Launch launch_;
    Job<KernelScene<Real>, Real> job_{};
    DeviceMemory reals_on_device_;
    DeviceMemory wholes_on_device_;
    DeviceMemory job_on_device_;
    std::optional<DeviceMemory> bytes_on_device_;
    std::optional<DeviceMemory> camera_on_device_;
    std::vector<Real> reals_;
    std::vector<int> wholes_;
    Work work_;
};

}  // namespace mandelmarch::job
