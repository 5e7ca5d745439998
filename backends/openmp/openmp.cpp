// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/openmp.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "backends/openmp/peak.h"
#include "backends/openmp/picture.h"
#include "backends/openmp/place.h"
#include "backends/openmp/stack_size.h"
#include "backends/openmp/threads.h"
#include "backends/openmp/variants.h"
#include "core/base/cores.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

using openmp::LatticeBuffers;
using openmp::ThreadMemory;
using openmp::TileQueue;
using openmp::Variant;

#pragma omp declare reduction(sum:Work : omp_out += omp_in)

// Renders bands, to planes in memory or directly to an image's bytes.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(const Scene& scene, const RendererOptions& options, const Variant<Real>& variant, Image& image,
                 std::span<ThreadMemory> memory, LatticeBuffers<Real>& notes, const Progress& progress)
        : picture_(scene, options.mode, options.techniques, variant, notes),
          variant_(variant),
          image_(image),
          memory_(memory),
          threads_(options.threads),
          chunk_(std::max(1, options.chunk)),
          progress_(progress)
    {
    }

    void run(Entry, const Band& band, int) override
    {
        const Clock::time_point start = Clock::now();
        const openmp::Target<Real> target = target_of(band);
        Work band_work;
        for (const openmp::Lattice& lattice : picture_.lattices()) {
            const openmp::Canvas<Real> canvas = picture_.canvas(lattice, band, target);
            TileQueue queue(image_.width(), band, chunk_, &progress_);
#pragma omp parallel num_threads(threads_) reduction(sum : band_work)
            {
                void* memory = memory_[static_cast<std::size_t>(omp_get_thread_num())].of_size(variant_.memory);
                TileQueue::Share share{queue};
                if (omp_get_thread_num() == 0) team = std::max(team, omp_get_num_threads());
                const openmp::WorkCounts spent = variant_.draw(&picture_.kernel_scene(), canvas, share.tiles(), memory);
                band_work += {spent.steps, spent.de_calls, spent.iterations};
            }
        }
        work += band_work;
        timings.ran(seconds_since(start));
    }

    bool marching(const Band&) override { return false; }

    // Bytes are already in the image; planes are converted to the image's values.
    void read_back(const Band& band, Image& image) override
    {
        if (!image.has_values()) return;
        const Clock::time_point start = Clock::now();
        const auto width = static_cast<std::size_t>(image.width());
        const std::size_t pixels = Image::pixels(image.width(), band.rows);
#pragma omp parallel for num_threads(threads_) schedule(dynamic)
        for (int row = 0; row < band.rows; ++row) {
            const std::size_t from = static_cast<std::size_t>(row) * width;
            const auto planes = planes_of(reals_.data() + from, wholes_.data() + from, pixels, width);
            image.store(planes, 0, band.first_row + row, image.width(), 1);
        }
        timings.readback += seconds_since(start);
    }

    Timings timings;
    Work work;
    int team = 1;  // threads used; OMP_DYNAMIC and OMP_THREAD_LIMIT may allow fewer than requested

private:
    // Returns the image's bytes as the destination, or buffers of planes if the image has values.
    openmp::Target<Real> target_of(const Band& band)
    {
        if (!image_.has_values()) {
            return {.bytes = image_.row_bytes(band.first_row)};
        }
        const std::size_t pixels = Image::pixels(image_.width(), band.rows);
        reals_.resize(std::max(reals_.size(), real_planes * pixels));
        wholes_.resize(std::max(wholes_.size(), whole_planes * pixels));
        return {.reals = reals_.data(), .wholes = wholes_.data()};
    }

    openmp::Picture<Real> picture_;
    const Variant<Real>& variant_;
    Image& image_;
    std::span<ThreadMemory> memory_;  // one per thread
    int threads_;
    int chunk_;
    const Progress& progress_;
    std::vector<Real> reals_;
    std::vector<int> wholes_;
};

Device host_device()
{
    return {.name = cpu_name(), .vendor = cpu_vendor(), .driver = fmt::format("OpenMP {}", _OPENMP), .is_gpu = false};
}

class OpenmpRenderer : public Renderer {
public:
    explicit OpenmpRenderer(const RendererOptions& options) : options_(options), targets_(openmp::instructions())
    {
        openmp::check_stack_size();
        if (options_.threads == 0) options_.threads = usable_threads();
        memory_ = std::vector<ThreadMemory>(static_cast<std::size_t>(options_.threads));
    }

    RenderStats render(const Scene& scene, Image& image, const Progress& progress) override
    {
        return options_.precision == Precision::f32 ? render_as<float>(scene, image, progress)
                                                    : render_as<double>(scene, image, progress);
    }

private:
    template <class Real>
    RenderStats render_as(const Scene& scene, Image& image, const Progress& progress)
    {
        const openmp::OwnPlace place;
        const Clock::time_point start = Clock::now();
        const Variant<Real> variant = choose<Real>(scene, !bytes_alone(image, options_));
        BandExecutor<Real> executor(scene, options_, variant, image, memory_, std::get<LatticeBuffers<Real>>(notes_),
                                    progress);
        run_schedule(scene, options_.mode, openmp::band_limits, executor, image, progress);
        RenderStats report{.backend = "openmp",
                           .device = host_device(),
                           .precision = options_.precision,
                           .mode = options_.mode,
                           .threads = executor.team,
                           .simd_width = variant.pack,
                           .instruction_set = openmp::usual_name(variant.instruction_set),
                           .timings = executor.timings,
                           .work = executor.work};
        report.timings.wall = seconds_since(start);
        return report;
    }

    template <class Real>
    Variant<Real> choose(const Scene& scene, bool counted) const
    {
        auto variants = openmp::variants_of<Real>(scene.fractal->name, options_.mode, targets_);
        if (counted) std::erase_if(variants, [](const auto& variant) { return !variant.counted; });
        if (options_.simd_width == 0) return variants.back();
        const auto of_width =
            std::ranges::find(variants.rbegin(), variants.rend(), options_.simd_width, &Variant<Real>::pack);
        if (of_width != variants.rend()) return *of_width;
        std::string widths;
        for (const auto& variant : variants) {
            if (!variant.counted) continue;
            widths += fmt::format("{}{}", widths.empty() ? "" : ", ", variant.pack);
        }
        throw InputError(
            fmt::format("--simd-width: {} is no SIMD width of openmp in {} on this machine, expected one of {}",
                        options_.simd_width, name_of(options_.precision), widths));
    }

    RendererOptions options_;
    std::int64_t targets_;
    std::vector<ThreadMemory> memory_;
    std::tuple<LatticeBuffers<float>, LatticeBuffers<double>> notes_;
};

class OpenmpBackend : public Backend {
public:
    std::string_view name() const override { return "openmp"; }
    BackendInfo info() const override
    {
        return {.role = Role::host,
                .threads = true,
                .simd_width = true,
                .chunk = true,
                .variables = {"OMP_NUM_THREADS", "OMP_THREAD_LIMIT", "OMP_DYNAMIC", "OMP_PROC_BIND", "OMP_PLACES",
                              "OMP_WAIT_POLICY", "GOMP_CPU_AFFINITY", "GOMP_SPINCOUNT"},
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
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
