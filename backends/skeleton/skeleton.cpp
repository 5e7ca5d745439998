// SPDX-License-Identifier: Apache-2.0
// A minimal backend to copy: the kernel as scalar C++ on one thread. See docs/add-a-backend.md.
#include <fmt/format.h>

#include <algorithm>

#include "backends/skeleton/kernel.h"
#include "core/text/error.h"
#include "core/os/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

// Renders bands on the device. The constructor allocates the buffers, run() runs the kernel on a band, and read_back()
// copies the band to the image.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(const Scene& scene, const RendererOptions& options, skeleton::DrawBand<Real>* draw, std::size_t pixels)
        : scene_(kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques)),
          draw_(draw),
          reals_(real_planes * pixels),
          wholes_(whole_planes * pixels),
          pixels_(pixels)
    {
        // A real device uploads scene_ here, and adds the time to timings.upload.
    }

    // The limits given to run_schedule() below do not limit loop iterations, so the entry is always Entry::draw.
    void run(Entry, const Band& band, int) override
    {
        const Clock::time_point start = Clock::now();
        draw_(scene_, band.first_row, band.rows, pixels_, reals_.data(), wholes_.data());
        timings.ran(seconds_since(start));
    }

    bool marching(const Band&) override { return false; }

    void read_back(const Band& band, Image& image) override
    {
        const Clock::time_point start = Clock::now();
        const auto planes = planes_of(reals_.data(), wholes_.data(), pixels_, static_cast<std::size_t>(scene_.width));
        image.store(planes, 0, band.first_row, scene_.width, band.rows);
        add_work(work, planes, scene_.width, band.rows);
        timings.readback += seconds_since(start);
    }

    Timings timings;
    Work work;

private:
    KernelScene<Real> scene_;
    skeleton::DrawBand<Real>* draw_;
    std::vector<Real> reals_;
    std::vector<int> wholes_;
    std::size_t pixels_;
};

Device only_device() { return {.name = "skeleton", .vendor = "mandelmarch", .driver = "none", .is_gpu = false}; }

class SkeletonRenderer : public Renderer {
public:
    explicit SkeletonRenderer(const RendererOptions& options) : options_(options) {}

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        return options_.precision == Precision::f32 ? draw<float>(scene, image, progress)
                                                    : draw<double>(scene, image, progress);
    }

private:
    template <class Real>
    RenderStats draw(const Scene& scene, Image& image, const Progress& progress) const
    {
        const std::string_view fractal = scene.fractal->name;
        skeleton::DrawBand<Real>* const kernel =
            skeleton::kernel_of<Real>(fmt::format("{}_{}", fractal, name_of(options_.precision)));
        if (kernel == nullptr) throw Unavailable(fmt::format("backend skeleton: it does not draw the {}", fractal));
        const Clock::time_point start = Clock::now();
        // The simulated device's memory holds most_pixels pixels. A band consists of complete rows.
        constexpr int most_pixels = 1 << 20;
        const int rows = std::clamp(most_pixels / scene.width, 1, scene.height);
        const std::int64_t pixels = std::int64_t{rows} * scene.width;
        BandExecutor<Real> executor(scene, options_, kernel, static_cast<std::size_t>(pixels));
        run_schedule(scene, options_.mode, {.pixels_per_band = pixels}, executor, image, progress);
        RenderStats report;
        report.backend = "skeleton";
        report.device = only_device();
        report.precision = options_.precision;
        report.mode = options_.mode;
        report.timings = executor.timings;
        report.timings.wall = seconds_since(start);
        report.work = executor.work;
        return report;
    }

    RendererOptions options_;
};

class SkeletonBackend : public Backend {
public:
    std::string_view name() const override { return "skeleton"; }
    BackendInfo info() const override
    {
        return {.title = "skeleton",
                .distribution = "one thread, pixel after pixel",
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    std::optional<std::string> unavailable() const override { return std::nullopt; }
    std::vector<Device> devices() const override { return {only_device()}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        if (options.device != 0) {
            throw Unavailable(fmt::format("backend skeleton: there is no device {}, only device 0", options.device));
        }
        return std::make_unique<SkeletonRenderer>(options);
    }
};

}  // namespace

std::unique_ptr<Backend> make_skeleton_backend() { return std::make_unique<SkeletonBackend>(); }

}  // namespace mandelmarch
