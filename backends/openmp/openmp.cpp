#include "backends/openmp/openmp.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <type_traits>

#include "backends/openmp/peak.h"
#include "backends/openmp/variants.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

using openmp::Variant;

template <class Real>
using KernelScene = std::conditional_t<std::is_same_v<Real, float>, layout_f32::Scene, layout_f64::Scene>;

void add_to(Work& to, const Work& from)
{
    to.steps += from.steps;
    to.estimates += from.estimates;
    to.iterations += from.iterations;
}
#pragma omp declare reduction(sum:Work : add_to(omp_out, omp_in))

// Tiles are drawn straight into the image, so that there is nothing to read back.
template <class Real>
class TileExecutor : public Executor {
public:
    TileExecutor(const Scene& scene, const RendererOptions& options, const Variant<Real>& variant, Image& image)
        : scene_(kernel_scene<KernelScene<Real>>(scene, options.mode)),
          variant_(variant),
          threads_(options.threads),
          chunk_(std::max(1, options.chunk)),
          image_(image)
    {
    }

    void run(Entry, const Band& band, int) override
    {
        const int columns = (scene_.width + tile_side - 1) / tile_side;
        const int rows = (band.rows + tile_side - 1) / tile_side;
        Work work;
#pragma omp parallel for num_threads(threads_) schedule(dynamic, chunk_) reduction(sum : work)
        for (int index = 0; index < columns * rows; ++index) {
            const int left = index % columns * tile_side;
            const int bottom = band.first_row + index / columns * tile_side;
            const int width = std::min(tile_side, scene_.width - left);
            const int height = std::min(tile_side, band.first_row + band.rows - bottom);
            Tile<Real> tile;
            variant_.draw(&scene_, left, bottom, tile);
            image_.store(planes_of(tile), left, bottom, width, height);
            add_work(work, planes_of(tile), width, height);
        }
        add_to(work_, work);
    }

    bool marching(const Band&) override { return false; }
    void read_back(const Band&, Image&) override {}

    const Work& work() const { return work_; }

private:
    KernelScene<Real> scene_;
    const Variant<Real>& variant_;
    int threads_;
    int chunk_;
    Image& image_;
    Work work_;
};

Device host_device()
{
    return {.name = cpu_name(), .vendor = cpu_vendor(), .driver = fmt::format("OpenMP {}", _OPENMP), .is_gpu = false};
}

class OpenmpRenderer : public Renderer {
public:
    explicit OpenmpRenderer(const RendererOptions& options) : options_(options)
    {
        if (options_.threads == 0) options_.threads = omp_get_num_procs();
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
        const auto start = std::chrono::steady_clock::now();
        const Variant<Real> variant = choose<Real>(scene);
        TileExecutor<Real> executor(scene, options_, variant, image);
        const auto begin = std::chrono::steady_clock::now();
        run_schedule(scene, options_.mode, {.pixels_per_band = 1 << 22}, executor, image, progress);
        const auto end = std::chrono::steady_clock::now();
        RenderReport report{.backend = "openmp",
                            .device = host_device(),
                            .precision = options_.precision,
                            .mode = options_.mode,
                            .threads = options_.threads,
                            .pack = variant.pack,
                            .instruction_set = variant.instruction_set,
                            .timings = {},
                            .work = executor.work()};
        report.timings.kernel = std::chrono::duration<double>(end - begin).count();
        report.timings.wall = std::chrono::duration<double>(end - start).count();
        return report;
    }

    template <class Real>
    Variant<Real> choose(const Scene& scene) const
    {
        const auto variants = openmp::variants_of<Real>(scene.fractal->name, options_.mode);
        if (options_.pack == 0) return variants.back();
        std::string widths;
        for (const auto& variant : variants) {
            if (variant.pack == options_.pack) return variant;
            widths += fmt::format("{}{}", widths.empty() ? "" : ", ", variant.pack);
        }
        throw InputError(fmt::format("--pack: {} is no pack width of openmp in {} on this machine, expected one of {}",
                                     options_.pack, name_of(options_.precision), widths));
    }

    RendererOptions options_;
};

class OpenmpBackend : public Backend {
public:
    std::string_view name() const override { return "openmp"; }
    std::optional<std::string> unavailable() const override { return std::nullopt; }
    std::vector<Device> devices() const override { return {host_device()}; }
    std::unique_ptr<Renderer> create(const RendererOptions& options) const override
    {
        if (options.device != 0) {
            throw Unavailable(fmt::format("backend openmp: there is no device {}, only device 0", options.device));
        }
        return std::make_unique<OpenmpRenderer>(options);
    }
    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        return openmp::multiply_add_peak(options.precision, options.threads);
    }
};

}  // namespace

std::unique_ptr<Backend> make_openmp_backend() { return std::make_unique<OpenmpBackend>(); }

}  // namespace mandelmarch
