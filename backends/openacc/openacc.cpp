// SPDX-License-Identifier: Apache-2.0
#include "backends/openacc/openacc.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <type_traits>

#include "backends/openacc/device.h"
#include "backends/openacc/kernels.h"
#include "backends/openacc/peak.h"
#include "core/base/console.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

using openacc::DeviceMemory;

// A band of 2^18 pixels fills the largest GPUs and ends well before a display's watchdog (seconds) on the K40; on the
// host a band only shows progress.
constexpr std::int64_t gpu_band = 1 << 18;   // pixels
constexpr std::int64_t host_band = 1 << 13;  // pixels
// Of a GPU's free memory, this share may be taken: others use it too.
constexpr std::size_t memory_share = 4;
// For a job, and what an allocation is rounded up to.
constexpr std::size_t job_memory = 1 << 16;  // bytes

template <class Real>
constexpr std::size_t pixel_bytes = real_planes * sizeof(Real) + whole_planes * sizeof(int);

// Adds the seconds of a call.
template <class Call>
void timed(double& seconds, const Call& call)
{
    const auto begin = Clock::now();
    call();
    seconds += seconds_since(begin);
}

template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(const Scene& scene, const RendererOptions& options, std::int64_t pixels, Timings& timings)
        : kernels_(openacc::kernels_of<Real>(scene.fractal->name, options.mode)),
          timings_(timings),
          reals_on_device_(static_cast<std::size_t>(pixels) * real_planes * sizeof(Real)),
          wholes_on_device_(static_cast<std::size_t>(pixels) * whole_planes * sizeof(int)),
          job_on_device_(sizeof(job_))
    {
        job_.scene = kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques);
        // The kernels take these two as fixed (kernel.h), but for normals of a tetrahedron.
        if (job_.scene.canonical != (options.mode == Mode::fast) ||
            (job_.scene.differences != 2 &&
             job_.scene.differences != (options.mode == Mode::exact && std::is_same_v<Real, double>))) {
            throw Unavailable("backend openacc: its kernels are not made for this scene's hit or normal");
        }
        job_.reals = static_cast<Real*>(reals_on_device_.address());
        job_.wholes = static_cast<int*>(wholes_on_device_.address());
    }

    // A whole pixel is asked for: its two kernels.
    void run(Entry, const Band& band, int) override
    {
        job_.first_row = band.first_row;
        job_.rows = band.rows;
        timed(timings_.upload, [&] { job_on_device_.upload(&job_, sizeof(job_)); });
        const int blocks = openacc::blocks_of(job_.scene.width, band.rows);
        timed(timings_.kernel, [&] {
            kernels_.march(job_on_device_.address(), blocks);
            kernels_.shade(job_on_device_.address(), blocks);
        });
    }

    bool marching(const Band&) override { return false; }

    void read_back(const Band& band, Image& image) override
    {
        const auto width = static_cast<std::size_t>(image.width());
        const std::size_t pixels = width * static_cast<std::size_t>(band.rows);
        timed(timings_.readback, [&] {
            reals_.resize(pixels * real_planes);
            wholes_.resize(pixels * whole_planes);
            reals_on_device_.read_back(reals_.data(), reals_.size() * sizeof(Real));
            wholes_on_device_.read_back(wholes_.data(), wholes_.size() * sizeof(int));
            const Planes<Real> planes = planes_of(reals_.data(), wholes_.data(), pixels, width);
            image.store(planes, 0, band.first_row, image.width(), band.rows);
            add_work(work_, planes, image.width(), band.rows);
        });
    }

    const Work& work() const { return work_; }

private:
    openacc::Kernels kernels_;
    Timings& timings_;
    openacc::Job<KernelScene<Real>, Real> job_{};
    DeviceMemory reals_on_device_;
    DeviceMemory wholes_on_device_;
    DeviceMemory job_on_device_;
    std::vector<Real> reals_;
    std::vector<int> wholes_;
    Work work_;
};

class OpenaccRenderer : public Renderer {
public:
    OpenaccRenderer(const RendererOptions& options, Device device, double context)
        : options_(options), device_(std::move(device)), context_(context)
    {
    }

    RenderReport render(const Scene& scene, Image& image, const Progress& progress) override
    {
        return options_.precision == Precision::f32 ? render_as<float>(scene, image, progress)
                                                    : render_as<double>(scene, image, progress);
    }

private:
    template <class Real>
    RenderReport render_as(const Scene& scene, Image& image, const Progress& progress)
    {
        RenderReport report{.backend = "openacc",
                            .device = device_,
                            .precision = options_.precision,
                            .mode = options_.mode,
                            .threads = 1,
                            .pack = 1,
                            .instruction_set = device_.is_gpu ? "PTX for sm_35" : "scalar",
                            .timings = {},
                            .work = {}};
        timed(report.timings.wall, [&] {
            openacc::use_device(device_, options_.device);
            const Limits limits = limits_for(scene, pixel_bytes<Real>);
            std::optional<BandExecutor<Real>> executor;
            timed(report.timings.upload,
                  [&] { executor.emplace(scene, options_, limits.pixels_per_band, report.timings); });
            run_schedule(scene, options_.mode, limits, *executor, image, progress);
            report.work = executor->work();
        });
        report.timings.context = context_;
        return report;
    }

    // At least a row, at most the picture.
    Limits limits_for(const Scene& scene, std::size_t bytes) const
    {
        const std::int64_t picture = std::int64_t{scene.width} * scene.height;
        std::int64_t pixels = device_.is_gpu ? gpu_band : host_band;
        if (device_.is_gpu) {
            const std::size_t free = openacc::free_memory(options_.device);
            pixels = std::min(pixels, static_cast<std::int64_t>(free / memory_share / bytes));
            const std::size_t needed = static_cast<std::size_t>(scene.width) * bytes + job_memory;
            if (free < needed) {
                throw Error(
                    fmt::format("openacc: {} has {} bytes of memory free, {} are needed", device_.name, free, needed));
            }
        }
        pixels = std::min(std::max<std::int64_t>(pixels, scene.width), picture);
        return {.pixels_per_band = pixels, .pixels_to_fill = pixels};
    }

    RendererOptions options_;
    Device device_;
    double context_;  // seconds
};

class OpenaccBackend : public Backend {
public:
    std::string_view name() const override { return "openacc"; }
    Facts facts() const override
    {
        return {.role = Role::accelerator,
                .has_driver = true,
                .variables = {"ACC_DEVICE_TYPE", "ACC_DEVICE_NUM", "CUDA_VISIBLE_DEVICES", "CUDA_CACHE_DISABLE"},
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    std::optional<std::string> unavailable() const override { return std::nullopt; }
    std::vector<Device> devices() const override
    {
        std::vector<Device> all(static_cast<std::size_t>(openacc::device_count()));
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = opened(static_cast<int>(i)).device;
        return all;
    }

    std::unique_ptr<Renderer> create(const RendererOptions& options) const override
    {
        const int last = openacc::device_count() - 1;
        if (options.device > last) {
            throw Unavailable(
                fmt::format("backend openacc: there is no device {}, only {}", options.device,
                            last == 0 ? "device 0, the host: no NVIDIA GPU is here" : fmt::format("0 to {}", last)));
        }
        const Opened found = opened(options.device);
        if (!found.device.is_gpu) say("backend openacc: runs on the {}\n", found.device.name);
        return std::make_unique<OpenaccRenderer>(options, found.device, found.seconds);
    }

    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        if (options.device >= openacc::device_count()) {
            throw Unavailable(fmt::format("backend openacc: there is no device {}", options.device));
        }
        const Device device = opened(options.device).device;
        openacc::use_device(device, options.device);
        return openacc::multiply_add_peak(device, options.precision);
    }

private:
    struct Opened {
        Device device;
        double seconds = 0;
    };

    // A device is opened once, when first asked for, and how long that took is its renderers' `context`.
    Opened opened(int index) const
    {
        const std::scoped_lock lock(mutex_);
        const bool first = !opened_.contains(index);
        Opened& found = opened_[index];
        if (first) timed(found.seconds, [&] { found.device = openacc::open_device(index); });
        return found;
    }

    mutable std::mutex mutex_;
    mutable std::map<int, Opened> opened_;
};

}  // namespace

std::unique_ptr<Backend> make_openacc_backend() { return std::make_unique<OpenaccBackend>(); }

}  // namespace mandelmarch
