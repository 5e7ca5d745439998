// SPDX-License-Identifier: Apache-2.0
// The OpenMP backend: the kernel on all cores of this machine. A core processes one pixel at a time, or a pack: a
// vector of pixels, one or more SIMD registers wide.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <tuple>
#include <vector>

#include "backends/openmp/picture.h"
#include "backends/openmp/place.h"
#include "backends/openmp/threads.h"
#include "backends/openmp/variants.h"
#include "core/os/cores.h"
#include "core/os/cpu.h"
#include "core/os/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/peak.h"
#include "core/render/schedule.h"
#include "core/scene/fractal.h"
#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace openmp {
namespace {

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
        const Target<Real> target = target_of(band);
        Work band_work;
        for (const Lattice& lattice : picture_.lattices()) {
            const Canvas<Real> canvas = picture_.canvas(lattice, band, target);
            TileQueue queue(image_.width(), band, chunk_, &progress_);
#pragma omp parallel num_threads(threads_) reduction(sum : band_work)
            {
                void* memory = memory_[static_cast<std::size_t>(omp_get_thread_num())].of_size(variant_.memory);
                TileQueue::Share share{queue};
                if (omp_get_thread_num() == 0) team = std::max(team, omp_get_num_threads());
                const WorkCounts spent = variant_.draw(picture_.kernel_scene(), canvas, share.tiles(), memory);
                band_work += {spent.steps, spent.de_calls, spent.iterations};
            }
        }
        work += band_work;
        timings.ran(seconds_since(start));
    }

    bool marching(const Band&) override { return false; }

    // Converts the planes to the image's values. If the image has only bytes, run() has already stored them.
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
    Target<Real> target_of(const Band& band)
    {
        if (!image_.has_values()) {
            return {.bytes = image_.row_bytes(band.first_row)};
        }
        const std::size_t pixels = Image::pixels(image_.width(), band.rows);
        reals_.resize(std::max(reals_.size(), real_planes * pixels));
        wholes_.resize(std::max(wholes_.size(), whole_planes * pixels));
        return {.reals = reals_.data(), .wholes = wholes_.data()};
    }

    Picture<Real> picture_;
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

constexpr double least_stack = 64;  // min stack size in KiB; a thread needs about 20 KiB

// Returns the size in KiB that a value of OMP_STACKSIZE sets (OpenMP 5.2, 21.2.2): a number, in KiB unless B, K, M or G
// follows. Returns 0 for a value that is not a number, which the run-time library ignores.
double kibibytes(const std::string& text)
{
    char* rest = nullptr;
    const double number = std::strtod(text.c_str(), &rest);
    while (std::isspace(static_cast<unsigned char>(*rest)) != 0) ++rest;
    switch (std::tolower(static_cast<unsigned char>(*rest))) {
        case 'b': return number / 1024;
        case 'm': return number * 1024;
        case 'g': return number * 1024 * 1024;
        default: return number;
    }
}

// Throws InputError if OMP_STACKSIZE or GOMP_STACKSIZE makes the threads' stacks too small for packs of rays. Without
// this check, the program would crash.
void check_stack_size()
{
    for (const VariableName name : {VariableName("OMP_STACKSIZE"), VariableName("GOMP_STACKSIZE")}) {
        const std::string text = environment_variable(name);
        const double size = kibibytes(text);
        if (size > 0 && size < least_stack) {
            throw InputError(fmt::format("{}: '{}' given, expected at least {:.0f}K", name.text, text, least_stack));
        }
    }
}

class OpenmpRenderer : public Renderer {
public:
    explicit OpenmpRenderer(const RendererOptions& options) : options_(options), targets_(instructions())
    {
        check_stack_size();
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
        const OwnPlace place(options_.threads);
        const Clock::time_point start = Clock::now();
        const Variant<Real> variant = choose<Real>(scene, !bytes_alone(image, options_));
        BandExecutor<Real> executor(scene, options_, variant, image, memory_, std::get<LatticeBuffers<Real>>(notes_),
                                    progress);
        run_schedule(scene, options_.mode, band_limits, executor, image, progress);
        RenderStats report{.backend = "openmp",
                           .device = host_device(),
                           .precision = options_.precision,
                           .mode = options_.mode,
                           .threads = executor.team,
                           .simd_width = variant.pack,
                           .instruction_set = usual_name(variant.instruction_set),
                           .timings = executor.timings,
                           .work = executor.work};
        report.timings.wall = seconds_since(start);
        return report;
    }

    template <class Real>
    Variant<Real> choose(const Scene& scene, bool counted) const
    {
        auto variants = variants_of<Real>(scene.fractal->name, options_.mode, targets_);
        if (counted) std::erase_if(variants, [](const auto& variant) { return !variant.counted; });
        if (options_.simd_width == 0) return variants.back();
        const auto of_width =
            std::ranges::find(variants.rbegin(), variants.rend(), options_.simd_width, &Variant<Real>::pack);
        if (of_width != variants.rend()) return *of_width;
        std::erase_if(variants, [](const auto& variant) { return !variant.counted; });
        const auto widths = mapped(variants, &Variant<Real>::pack);
        throw InputError(
            fmt::format("--simd-width: {} is no SIMD width of openmp in {} on this machine, expected one of {}",
                        options_.simd_width, name_of(options_.precision), fmt::join(widths, ", ")));
    }

    RendererOptions options_;
    std::int64_t targets_;
    std::vector<ThreadMemory> memory_;
    std::tuple<LatticeBuffers<float>, LatticeBuffers<double>> notes_;
};

// Returns the multiply-add peak of `threads` threads together, in operations per second. If `threads` is 0, uses
// usable_threads().
double measured_peak(Precision precision, int threads)
{
    const PeakKernel kernel =
        precision == Precision::f32 ? peak_kernel_float(instructions()) : peak_kernel_double(instructions());
    const int asked = threads == 0 ? usable_threads() : threads;
    const OwnPlace place(asked);
    const PeakRun run = [&](int rounds) {
        const auto start = Clock::now();
        double sum = 0;
        int team = 1;
#pragma omp parallel num_threads(asked) reduction(+ : sum) reduction(max : team)
        {
            team = omp_get_num_threads();
            sum += kernel.run(rounds);
        }
        // If OMP_THREAD_LIMIT or OMP_DYNAMIC makes the team smaller than requested, it does only a part of the work.
        // The measured time is therefore scaled to all of the work.
        const double seconds = seconds_since(start) * asked / team;
        if (!(sum > 0)) throw Error("backend openmp: the multiply-add kernel computes nonsense");
        return seconds;
    };
    return highest_rate(run, static_cast<double>(kernel.lanes) * asked);
}

class OpenmpBackend : public Backend {
public:
    std::string_view name() const override { return "openmp"; }
    BackendInfo info() const override
    {
        return {.title = "OpenMP",
                .distribution =
                    "each thread takes tiles of 16 x 16 pixels from a shared counter; within a thread, "
                    "packs of SIMD lanes with ended rays replaced",
                .role = Role::host,
                .threads = true,
                .simd_width = true,
                .chunk = true,
                .concurrent = true,
                .build = {MANDELMARCH_BUILD_COMPILER, MANDELMARCH_BUILD_EXACT, MANDELMARCH_BUILD_FAST}};
    }
    std::vector<Device> devices() const override { return {host_device()}; }
    std::unique_ptr<Renderer> do_create(const RendererOptions& options) const override
    {
        if (options.device != 0) {
            throw Unavailable(fmt::format("backend openmp: there is no device {}, only device 0", options.device));
        }
        return std::make_unique<OpenmpRenderer>(options);
    }
    std::optional<double> multiply_add_peak(const RendererOptions& options) const override
    {
        return measured_peak(options.precision, options.threads);
    }
};

}  // namespace
}  // namespace openmp

std::unique_ptr<Backend> make_openmp_backend() { return std::make_unique<openmp::OpenmpBackend>(); }

}  // namespace mandelmarch
