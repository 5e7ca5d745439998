// SPDX-License-Identifier: Apache-2.0
// Runs the schedule on a programming model's device.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/models/camera_table.h"
#include "core/models/model.h"
#include "core/os/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"

namespace mandelmarch::job {

// Runs `call` and adds its duration to `seconds`.
template <class Call>
void timed(double& seconds, const Call& call)
{
    const auto begin = Clock::now();
    call();
    seconds += seconds_since(begin);
}

// A buffer that grows and is reused between pictures. It must be used and destroyed while a selection of
// Model::select() lives.
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
    DeviceMemory starts, cone_work, depths;
    Staging host_reals, host_wholes;
    std::vector<std::byte> camera_on_device;  // the contents of `camera`

    explicit Memory(const Model& model)
        : reals(model),
          wholes(model),
          bytes(model),
          camera(model),
          job(model),
          starts(model),
          cone_work(model),
          depths(model),
          host_reals(model),
          host_wholes(model)
    {
    }
    // Returns the bytes of the device buffers whose sizes depend on the band.
    std::size_t held() const { return reals.size() + wholes.size() + bytes.size(); }
    // Returns the max number of pixels of a band whose planes, of `bytes_per_pixel`, fit in the buffers.
    std::size_t band_pixels(std::size_t bytes_per_pixel) const
    {
        return (reals.size() + wholes.size()) / bytes_per_pixel;
    }
};

template <class Real>
constexpr std::size_t pixel_bytes = real_planes * sizeof(Real) + whole_planes * sizeof(int);

// Renders bands within the limits.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(const Model& model, const OpenedDevice& opened, Memory& memory, DrawKernel* launch, const Scene& scene,
                 const RendererOptions& options, const Limits& limits, bool bytes_alone, Timings& timings)
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
        const auto most = static_cast<std::size_t>(limits.pixels_per_band);
        job_.camera = static_cast<const Real*>(uploaded_camera());
        job_.reals = static_cast<Real*>(memory.reals.of_size(most * real_planes * sizeof(Real)));
        job_.wholes = static_cast<int*>(memory.wholes.of_size(most * whole_planes * sizeof(int)));
        job_.bytes = bytes_alone ? static_cast<unsigned char*>(memory.bytes.of_size(3 * most)) : nullptr;
        fit_starts(scene, limits);
        on_device_ = static_cast<OnDevice*>(memory.job.of_size(sizeof(OnDevice)));
        job_.taken = &on_device_->taken;
        warps_ = options.resident_warps > 0 ? options.resident_warps : opened.resident_warps;
    }

    // Prepares a whole picture, which another executor then renders by render_beside().
    void prepare(const Band& band)
    {
        if (job_.cone_side > 0) task_.tiles = tiles_of(job_.scene.width, band.rows, job_.cone_side);
        fill(band);
    }

    // Renders the pictures that the others have prepared, at the same time as this executor's first band.
    void render_beside(std::vector<BandExecutor*> others) { beside_ = std::move(others); }

    // The renderer's Limits have no limit of loop iterations, so the entry is Entry::cones or Entry::draw.
    void run(Entry entry, const Band& band, int) override
    {
        if (entry == Entry::cones) {
            // They are marched together with the pixels of the first lattice.
            task_.tiles = tiles_of(job_.scene.width, band.rows, band.cones.side);
            return;
        }
        fill(band);
        std::vector<BandExecutor*> all = std::exchange(beside_, {});
        all.push_back(this);
        std::vector<Task> tasks(all.size());
        const std::scoped_lock turn(*opened_.turn);
        timed(timings_.upload, [&] {
            for (std::size_t i = 0; i < all.size(); ++i) tasks[i].job = all[i]->uploaded();
            if (model_.kernels().take_job) launch_(tasks);
        });
        for (std::size_t i = 0; i < all.size(); ++i) {
            all[i]->task_.job = tasks[i].job;
            tasks[i] = std::exchange(all[i]->task_, {});
        }
        double by_device = 0;
        double by_host = 0;
        timed(by_host, [&] { by_device = model_.seconds_of([&] { launch_(tasks); }); });
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
            add_cone_work(band);
        });
    }

    const Work& work() const { return work_; }

private:
    // The count of taken pixels, and the job unless Kernels::take_job. They are in different cache lines, because the
    // count's changes would delay reading the job.
    struct OnDevice {
        int taken = 0;
        KernelArguments<KernelScene<Real>, Real> job;
    };

    // Sets the job and the task to the pixels of a band.
    void fill(const Band& band)
    {
        const int width = job_.scene.width;
        const int most = blocks_of(width, band.rows) * block_threads;
        const int held = opened_.multiprocessors * warps_ * warp_threads;
        task_.cells = tiles_of(width, band.rows, cell_side(band.lattice));
        task_.threads = held > 0 ? std::min(held, most) : most;
        job_.first_row = band.first_row;
        job_.rows = band.rows;
        job_.lattice = band.lattice;
        // Large chunks keep the lanes of a warp busy; small ones share the pixels evenly among the warps.
        job_.chunk = warp_threads * std::clamp(most / task_.threads / 12, 1, 4);
    }

    // Returns the address of the job for the kernels; uploads the job, unless they take it from the host.
    const void* uploaded()
    {
        if (model_.kernels().take_job) return &job_;
        const OnDevice uploaded{.taken = 0, .job = job_};
        model_.upload(on_device_, &uploaded, sizeof uploaded);
        return &on_device_->job;
    }

    // Allocates the buffers of cones and lattices.
    void fit_starts(const Scene& scene, const Limits& limits)
    {
        const int rows = rows_per_band(scene, limits);
        job_.cone_side = limits.starts.tile_side();
        if (job_.cone_side > 0) {
            const auto tiles = static_cast<std::size_t>(tiles_of(scene.width, rows, job_.cone_side));
            job_.starts = static_cast<Real*>(memory_.starts.of_size(tiles * sizeof(Real)));
            job_.cone_work = static_cast<int*>(memory_.cone_work.of_size(2 * tiles * sizeof(int)));
        }
        if (limits.starts.lattices.count > 1) {
            const std::size_t depths = Image::pixels(scene.width, rows) / 2 + 1;
            job_.depths = static_cast<Real*>(memory_.depths.of_size(depths * sizeof(Real)));
        }
    }

    // Adds the work of the band's cones.
    void add_cone_work(const Band& band)
    {
        if (job_.cone_side == 0) return;
        std::vector<int> spent(2 * static_cast<std::size_t>(tiles_of(job_.scene.width, band.rows, job_.cone_side)));
        model_.read_back(spent.data(), job_.cone_work, spent.size() * sizeof(int));
        mandelmarch::add_cone_work(work_, spent);
    }

    // Returns the address of the scene's camera table on the device. Uploads it unless the last picture's table was
    // equal.
    const void* uploaded_camera()
    {
        const std::vector<Real> table = camera_table(job_.scene);
        const auto* first = reinterpret_cast<const std::byte*>(table.data());
        const std::size_t size = table.size() * sizeof(Real);
        std::vector<std::byte>& on_device = memory_.camera_on_device;
        if (size > memory_.camera.size()) on_device.clear();  // `camera` is replaced
        void* camera = memory_.camera.of_size(size);
        if (!std::equal(on_device.begin(), on_device.end(), first, first + size)) {
            on_device.clear();
            model_.upload(camera, first, size);
            on_device.assign(first, first + size);
        }
        return camera;
    }

    const Model& model_;
    const OpenedDevice& opened_;
    Memory& memory_;
    Timings& timings_;
    DrawKernel* launch_;
    Task task_;                          // the work of the next launch
    std::vector<BandExecutor*> beside_;  // their pictures are rendered together with the next band
    KernelArguments<KernelScene<Real>, Real> job_{};
    OnDevice* on_device_ = nullptr;
    int warps_ = 0;  // number of warps that render at once on a multiprocessor
    Work work_;
};

}  // namespace mandelmarch::job
