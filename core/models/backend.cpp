// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <new>

#include "core/models/executor.h"
#include "core/render/peak.h"
#include "core/render/spacing.h"
#include "core/text/console.h"

namespace mandelmarch::job {
namespace {

// A band uses at most 1 / memory_share of a device's free memory, because other programs need some, too.
constexpr std::size_t memory_share = 4;
// Target time of a band on the host. It is short, because a picture can be cancelled only between bands.
constexpr double seconds_per_band = 0.1;
// Pixels of a band on the host if the picture has cones or lattices, so that bands must not depend on times. Small for
// the same reason.
constexpr std::int64_t fixed_band = 1 << 17;
// Device memory for a KernelArguments, including the rounding of allocations.
constexpr std::size_t job_memory = 1 << 16;  // bytes
// Alignment of host memory: a cache line, which is at least the alignment of a Scene.
constexpr std::align_val_t alignment{64};

class JobRenderer : public Renderer {
public:
    JobRenderer(std::shared_ptr<const Model> model, const RendererOptions& options, OpenedDevice opened, double context)
        : model_(std::move(model)),
          options_(options),
          opened_(std::move(opened)),
          context_(context),
          memory_(std::make_unique<Memory>(*model_))
    {
    }
    ~JobRenderer() override
    {
        try {
            const Selection selection = model_->select(options_);
            memory_.reset();
            beside_.clear();
        } catch (const Error&) {
            // A lost device has lost its memory, so the buffers are not freed.
            static_cast<void>(memory_.release());
            for (auto& memory : beside_) static_cast<void>(memory.release());
        }
    }
    JobRenderer(const JobRenderer&) = delete;
    JobRenderer& operator=(const JobRenderer&) = delete;

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        return options_.precision == Precision::f32 ? render_as<float>({}, scene, image, progress)
                                                    : render_as<double>({}, scene, image, progress);
    }

    // On a GPU, the small pictures occupy few of the multiprocessors. On the host, they would delay the picture.
    std::optional<RenderStats> render_beside(std::span<SmallPicture> small, const Scene& scene, Image& image,
                                             const Progress& progress) override
    {
        if (!opened_.device.is_gpu || !model_->kernels().take_job) return std::nullopt;
        return options_.precision == Precision::f32 ? render_as<float>(small, scene, image, progress)
                                                    : render_as<double>(small, scene, image, progress);
    }

    std::shared_ptr<void> lock_memory(std::span<std::uint8_t> memory) override
    {
        const Selection selection = model_->select(options_);
        return model_->lock_memory(memory);
    }

private:
    template <class Real>
    RenderStats render_as(std::span<SmallPicture> small, const Scene& scene, Image& image, const Progress& progress)
    {
        RenderStats report{.backend = std::string(model_->name()),
                           .device = opened_.device,
                           .precision = options_.precision,
                           .mode = options_.mode,
                           .threads = model_->threads(options_, opened_),
                           .simd_width = 1,
                           .instruction_set = opened_.instruction_set,
                           .timings = {},
                           .work = {}};
        timed(report.timings.wall, [&] {
            const Selection selection = model_->select(options_);
            DrawKernel* const launch = launch_of(scene);
            if (!built_.contains(launch)) {
                timed(report.timings.build, [&] { built_[launch] = model_->build(launch); });
            }
            report.kernels = built_.at(launch);
            Limits limits = limits_for(scene, pixel_bytes<Real>);
            limits.starts = starts_for(scene);
            if (has_starts(limits.starts) && limits.seconds_per_band > 0) {
                limits.pixels_per_band = limits.pixels_to_fill = std::min(limits.pixels_per_band, fixed_band);
            }
            std::optional<BandExecutor<Real>> executor;
            std::deque<BandExecutor<Real>> others;
            timed(report.timings.upload, [&] {
                executor.emplace(*model_, opened_, *memory_, launch, scene, options_, limits,
                                 bytes_alone(image, options_), report.timings);
                std::vector<BandExecutor<Real>*> beside;
                for (const SmallPicture& one : small) {
                    while (beside_.size() <= others.size()) beside_.push_back(std::make_unique<Memory>(*model_));
                    const std::int64_t pixels = one.image.pixels();
                    const Limits whole{.pixels_per_band = pixels, .starts = starts_for(one.scene)};
                    beside.push_back(&others.emplace_back(*model_, opened_, *beside_[others.size()], launch, one.scene,
                                                          options_, whole, true, report.timings));
                    beside.back()->prepare({0, one.scene.height});
                }
                executor->render_beside(std::move(beside));
            });
            run_schedule(scene, options_.mode, limits, *executor, image, progress);
            for (std::size_t i = 0; i < small.size(); ++i)
                others[i].read_back({0, small[i].scene.height}, small[i].image);
            report.work = executor->work();
        });
        report.timings.context = context_;
        return report;
    }

    // Returns the passes that find where rays begin. Threads of a GPU have cones of small tiles, because a warp waits
    // for its slowest ray, and neighbours save steps of the fastest rays only.
    Starts starts_for(const Scene& scene) const
    {
        const auto kernel = kernel_scene<layout_f64::Scene>(scene, options_.mode, options_.techniques);
        const int side = opened_.in_cells ? subtile_side : gpu_cone_side;
        return starts_of(kernel, *scene.fractal, options_.techniques, side, 0, opened_.in_cells);
    }

    DrawKernel* launch_of(const Scene& scene) const
    {
        const std::string_view fractal = scene.fractal->name;
        DrawKernel* const launch = model_->kernels().drawing(variant_name(fractal, options_.precision, options_.mode));
        if (launch == nullptr) {
            throw Unavailable(
                fmt::format("backend {}: this build has no kernel of the fractal '{}'", model_->name(), fractal));
        }
        return launch;
    }

    // Returns the limits of a picture's bands: at least one row, at most the whole picture. `bytes`: device memory per
    // pixel. Throws Error if the free memory does not suffice for one row.
    Limits limits_for(const Scene& scene, std::size_t bytes)
    {
        const std::int64_t picture = std::int64_t{scene.width} * scene.height;
        std::int64_t pixels = options_.band > 0 ? options_.band : opened_.pixels_per_band;
        double seconds = 0;
        const std::int64_t wanted = std::min(std::max<std::int64_t>(pixels, scene.width), picture);
        if (on_device_ && memory_->band_pixels(bytes) >= static_cast<std::size_t>(wanted)) {
            return {.pixels_per_band = wanted, .pixels_to_fill = wanted};
        }
        if (auto free = model_->free_memory(options_.device)) {
            on_device_ = true;
            *free += memory_->held();  // buffers that would be freed before larger ones are allocated
            pixels = std::min(pixels, static_cast<std::int64_t>(*free / memory_share / bytes));
            const std::size_t needed = static_cast<std::size_t>(scene.width) * bytes + job_memory;
            if (*free < needed) {
                throw Error(fmt::format("{}: {} has {} bytes of memory free, {} are needed", model_->name(),
                                        opened_.device.name, *free, needed));
            }
        } else if (options_.band == 0) {
            seconds = seconds_per_band;
        }
        pixels = std::min(std::max<std::int64_t>(pixels, scene.width), picture);
        return {.pixels_per_band = pixels, .pixels_to_fill = pixels, .seconds_per_band = seconds};
    }

    std::shared_ptr<const Model> model_;
    RendererOptions options_;
    OpenedDevice opened_;
    double context_;  // seconds
    std::map<DrawKernel*, std::vector<KernelResources>> built_;
    std::unique_ptr<Memory> memory_;
    std::vector<std::unique_ptr<Memory>> beside_;  // one for each small picture of render_beside()
    bool on_device_ = false;                       // the buffers are in a device's own memory, not the host's
};

class JobBackend : public Backend {
public:
    explicit JobBackend(std::unique_ptr<Model> model) : model_(std::move(model)) {}

    std::string_view name() const override { return model_->name(); }
    BackendInfo info() const override
    {
        BackendInfo info = model_->info();
        info.band = true;
        return info;
    }
    std::optional<std::string> unavailable() const override { return model_->unavailable(); }

    std::vector<Device> devices() const override
    {
        if (unavailable()) return {};
        std::vector<Device> all(static_cast<std::size_t>(model_->devices()));
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = opened(static_cast<int>(i)).opened.device;
        return all;
    }

    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        const OpenedInTime found = asked_for(options);
        if (!found.opened.note.empty()) say("backend {}: {}\n", name(), found.opened.note);
        return std::make_unique<JobRenderer>(model_, options, found.opened, found.seconds);
    }

    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        const int threads = asked_for(options).opened.peak_threads;
        Chains* const chains = model_->kernels().chains(name_of(options.precision));
        const Selection selection = model_->select(options);
        DeviceMemory memory(*model_);
        void* sums = memory.of_size(static_cast<std::size_t>(threads) * sizeof(double));
        const PeakRun run = [&](int rounds) {
            return model_->seconds_of([&] { chains(sums, threads, peak_factor, peak_addend, rounds); });
        };
        return highest_rate(run, threads);
    }

private:
    struct OpenedInTime {
        OpenedDevice opened;
        double seconds = 0;
    };

    OpenedInTime asked_for(const RendererOptions& options) const
    {
        if (const auto why = unavailable()) throw Unavailable(fmt::format("backend {}: {}", name(), *why));
        const int last = model_->devices() - 1;
        if (options.device > last) {
            const std::string only =
                last == 0 ? fmt::format("device 0, {}", opened(0).opened.device.name) : fmt::format("0 to {}", last);
            throw Unavailable(fmt::format("backend {}: there is no device {}, only {}", name(), options.device, only));
        }
        return opened(options.device);
    }

    // Returns a device; opens it on the first call. The time for opening it becomes Timings::context of the device's
    // renderers.
    OpenedInTime opened(int index) const
    {
        const std::scoped_lock lock(mutex_);
        if (const auto known = opened_.find(index); known != opened_.end()) return known->second;
        OpenedInTime found;
        timed(found.seconds, [&] { found.opened = model_->open(index); });
        return opened_[index] = found;
    }

    std::shared_ptr<const Model> model_;
    mutable std::mutex mutex_;
    mutable std::map<int, OpenedInTime> opened_;
};

}  // namespace

void* Model::allocate(std::size_t bytes) const { return ::operator new(bytes, alignment, std::nothrow); }
void Model::release(void* address) const { ::operator delete(address, alignment); }
void Model::upload(void* to, const void* from, std::size_t bytes) const { std::memcpy(to, from, bytes); }
void Model::read_back(void* to, const void* from, std::size_t bytes) const { std::memcpy(to, from, bytes); }
void* Model::allocate_staging(std::size_t bytes) const { return ::operator new(bytes, alignment, std::nothrow); }
void Model::release_staging(void* address) const { ::operator delete(address, alignment); }

double Model::seconds_of(const std::function<void()>& launch) const
{
    double seconds = 0;
    timed(seconds, launch);
    return seconds;
}

std::unique_ptr<Backend> backend_of(std::unique_ptr<Model> model)
{
    return std::make_unique<JobBackend>(std::move(model));
}

}  // namespace mandelmarch::job
