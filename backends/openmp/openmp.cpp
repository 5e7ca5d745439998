// SPDX-License-Identifier: Apache-2.0
#include "backends/openmp/openmp.h"

#include <fmt/format.h>
#include <hwy/targets.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>
#include <tuple>
#include <vector>

#include "backends/openmp/peak.h"
#include "backends/openmp/spacing.h"
#include "backends/openmp/stack_size.h"
#include "backends/openmp/threads.h"
#include "backends/openmp/variants.h"
#include "core/base/cpu.h"
#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"

namespace mandelmarch {
namespace {

using openmp::Notes;
using openmp::ThreadMemory;
using openmp::TileQueue;
using openmp::Variant;
constexpr std::int64_t band_pixels = 1 << 21;  // 28 bytes a pixel in float, 44 in double

void add_to(Work& to, const Work& from)
{
    to.steps += from.steps;
    to.estimates += from.estimates;
    to.iterations += from.iterations;
}
#pragma omp declare reduction(sum:Work : add_to(omp_out, omp_in))

// Draws bands through planes in memory.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(const Scene& scene, const RendererOptions& options, const Variant<Real>& variant, Image& image,
                 std::span<ThreadMemory> memory, Notes<Real>& notes)
        : scene_(kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques)),
          variant_(variant),
          image_(image),
          memory_(memory),
          notes_(notes),
          threads_(options.threads),
          lattices_(variant.pack > 1 ? openmp::lattices_of(scene_, *scene.fractal, options.techniques)
                                     : openmp::all_at_once),
          spacing_(openmp::spacing_of(scene_)),
          cones_(openmp::cones_pay(scene_, *scene.fractal, options.techniques)),
          block_hull_(openmp::block_hull_of(scene_, *scene.fractal)),
          chunk_(std::max(1, options.chunk))
    {
    }

    void run(Entry, const Band& band, int) override
    {
        const Clock::time_point start = Clock::now();
        const std::size_t pixels = static_cast<std::size_t>(band.rows) * static_cast<std::size_t>(scene_.width);
        unsigned char* bytes = nullptr;
        if (image_.has_values()) {
            reals_.resize(std::max(reals_.size(), real_planes * pixels));
            wholes_.resize(std::max(wholes_.size(), whole_planes * pixels));
        } else {
            bytes = image_.bytes().data() +
                    3 * static_cast<std::size_t>(band.first_row) * static_cast<std::size_t>(scene_.width);
        }
        notes_.fit(scene_.width, band.rows);
        Work band_work;
        openmp::Canvas<Real> canvas{.first_row = band.first_row,
                                    .end_row = band.first_row + band.rows,
                                    .pixels = static_cast<std::ptrdiff_t>(pixels),
                                    .spacing = spacing_,
                                    .cones = cones_,
                                    .block_hull = block_hull_,
                                    .lattice = {},
                                    .starts = notes_.starts.data(),
                                    .hits = notes_.hits.data(),
                                    .reals = reals_.data(),
                                    .wholes = wholes_.data(),
                                    .bytes = bytes};
        for (const openmp::Lattice& lattice : lattices_) {
            canvas.lattice = lattice;
            TileQueue queue(scene_.width, band, chunk_);
#pragma omp parallel num_threads(threads_) reduction(sum : band_work)
            {
                void* memory = memory_[static_cast<std::size_t>(omp_get_thread_num())].of_size(variant_.memory);
                TileQueue::Share share{queue};
                const openmp::Spent spent = variant_.draw(&scene_, canvas, share.tiles(), memory);
                add_to(band_work, {spent.steps, spent.estimates, spent.iterations});
            }
        }
        add_to(work, band_work);
        timings.kernel += seconds_since(start);
    }

    bool marching(const Band&) override { return false; }

    void read_back(const Band& band, Image& image) override
    {
        const Clock::time_point start = Clock::now();
        const auto width = static_cast<std::size_t>(scene_.width);
        const std::size_t pixels = static_cast<std::size_t>(band.rows) * width;
        if (!image.has_values()) return;  // its bytes are there
#pragma omp parallel for num_threads(threads_) schedule(dynamic)
        for (int row = 0; row < band.rows; ++row) {
            const std::size_t from = static_cast<std::size_t>(row) * width;
            const auto planes = planes_of(reals_.data() + from, wholes_.data() + from, pixels, width);
            image.store(planes, 0, band.first_row + row, scene_.width, 1);
        }
        timings.readback += seconds_since(start);
    }

    Timings timings;
    Work work;

private:
    KernelScene<Real> scene_;
    const Variant<Real>& variant_;
    Image& image_;
    std::span<ThreadMemory> memory_;  // each thread's
    Notes<Real>& notes_;
    int threads_;
    openmp::Lattices lattices_;
    Real spacing_;
    bool cones_;
    Real block_hull_;
    int chunk_;
    std::vector<Real> reals_;
    std::vector<int> wholes_;
};

Device host_device()
{
    return {.name = cpu_name(), .vendor = cpu_vendor(), .driver = fmt::format("OpenMP {}", _OPENMP), .is_gpu = false};
}

// An instruction set by its maker's name; Highway calls AVX-512 AVX3.
std::string usual_name(std::string_view highway)
{
    constexpr std::string_view avx3 = "AVX3";
    if (!highway.starts_with(avx3)) return std::string(highway);
    return fmt::format("AVX-512{}", highway.substr(avx3.size()));
}

// MANDELMARCH_INSTRUCTIONS in the environment takes a smaller instruction set than the machine's best: SSE4, AVX2 or
// AVX-512, Highway's names too. Empty counts as not set.
void choose_instructions()
{
    const char* wanted = std::getenv("MANDELMARCH_INSTRUCTIONS");
    hwy::SetSupportedTargetsForTest(0);  // what the machine has
    if (wanted == nullptr || *wanted == '\0') return;
    std::string known;
    for (std::int64_t rest = hwy::SupportedTargets() & HWY_TARGETS; rest != 0; rest &= rest - 1) {
        const std::int64_t target = rest & -rest;
        const std::string name = usual_name(hwy::TargetName(target));
        if (name == wanted || std::string_view(hwy::TargetName(target)) == wanted) {
            hwy::SetSupportedTargetsForTest(target);
            return;
        }
        known += fmt::format("{}{}", known.empty() ? "" : ", ", name);
    }
    throw InputError(
        fmt::format("MANDELMARCH_INSTRUCTIONS: '{}' given, expected one of {} on this machine", wanted, known));
}

class OpenmpRenderer : public Renderer {
public:
    explicit OpenmpRenderer(const RendererOptions& options) : options_(options)
    {
        openmp::check_stack_size();
        choose_instructions();
        if (options_.threads == 0) options_.threads = omp_get_num_procs();
        memory_ = std::vector<ThreadMemory>(static_cast<std::size_t>(options_.threads));
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
        const Clock::time_point start = Clock::now();
        const Variant<Real> variant = choose<Real>(scene, options_.counts || image.has_values());
        BandExecutor<Real> executor(scene, options_, variant, image, memory_, std::get<Notes<Real>>(notes_));
        // Large bands: at the end of each the threads run out of rays to fill their lanes with.
        run_schedule(scene, options_.mode, {.pixels_per_band = band_pixels, .pixels_to_fill = band_pixels}, executor,
                     image, progress);
        RenderReport report{.backend = "openmp",
                            .device = host_device(),
                            .precision = options_.precision,
                            .mode = options_.mode,
                            .threads = options_.threads,
                            .pack = variant.pack,
                            .instruction_set = usual_name(variant.instruction_set),
                            .timings = executor.timings,
                            .work = executor.work};
        report.timings.wall = seconds_since(start);
        return report;
    }

    template <class Real>
    Variant<Real> choose(const Scene& scene, bool counted) const
    {
        auto variants = openmp::variants_of<Real>(scene.fractal->name, options_.mode);
        if (counted) std::erase_if(variants, [](const auto& variant) { return !variant.counted; });
        if (options_.pack == 0) return variants.back();
        const auto of_width =
            std::ranges::find(variants.rbegin(), variants.rend(), options_.pack, &Variant<Real>::pack);
        if (of_width != variants.rend()) return *of_width;
        std::string widths;
        for (const auto& variant : variants) {
            if (!variant.counted) continue;
            widths += fmt::format("{}{}", widths.empty() ? "" : ", ", variant.pack);
        }
        throw InputError(fmt::format("--pack: {} is no pack width of openmp in {} on this machine, expected one of {}",
                                     options_.pack, name_of(options_.precision), widths));
    }

    RendererOptions options_;
    std::vector<ThreadMemory> memory_;
    std::tuple<Notes<float>, Notes<double>> notes_;
};

class OpenmpBackend : public Backend {
public:
    std::string_view name() const override { return "openmp"; }
    Facts facts() const override
    {
        return {.role = Role::host,
                .threads = true,
                .pack = true,
                .chunk = true,
                .variables = {"OMP_NUM_THREADS", "OMP_PROC_BIND", "OMP_PLACES", "OMP_WAIT_POLICY", "GOMP_CPU_AFFINITY",
                              "GOMP_SPINCOUNT"},
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
