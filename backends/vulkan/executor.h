// SPDX-License-Identifier: Apache-2.0
// Runs the schedule's passes on a device. Defines the layout of the buffers and the limits of a pass.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "backends/vulkan/probe.h"
#include "core/instruments/loops.h"
#include "core/os/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"
#include "core/render/spacing.h"

namespace mandelmarch::vulkan {

// The following constants must be the same as in kernel.comp.
inline constexpr int group_side = 8;
enum Stage : int {
    stage_begin = 1,
    stage_march = 2,
    stage_stop = 4,
    stage_refine = 8,
    stage_shade = 16,
    stage_bytes = 32,
    stage_pack = 64,
    stage_cones = 128
};

// The buffers of a Workbench. `results` contains two flags ("a ray is still marching" and "a ray was cut off"), the
// planes of reals, and the planes of integers. Each of these three parts begins at a multiple of 256 bytes, the
// largest alignment that a device may require. If only bytes are needed, they replace the planes of reals. `mirror`
// is a copy of the results that the host can read, for devices with separate memory. The host can read `cone_work`.
enum Index : std::size_t { scene_buffer, ray_buffer, result_buffer, start_buffer, cone_work_buffer, mirror_buffer };
constexpr vk::DeviceSize aligned(vk::DeviceSize size) { return (size + 255) / 256 * 256; }
inline constexpr vk::DeviceSize flag_size = 4;
inline constexpr vk::DeviceSize flags_size = 2 * flag_size;
inline constexpr vk::DeviceSize reals_at = aligned(flags_size);

// Returns the size of a Ray in std430, which is also that of a Hit: a vec3, six reals and three ints, padded to a
// multiple of four reals.
constexpr vk::DeviceSize ray_size(vk::DeviceSize real) { return 12 * real; }
static_assert(sizeof(layout_f32::Ray) == ray_size(4) && sizeof(layout_f32::Hit) == ray_size(4));
static_assert(sizeof(layout_f64::Ray) == 88 && sizeof(layout_f64::Hit) == 88);  // without the padding

// Max number of loop iterations of an invocation in one pass. lavapipe silently ends an invocation's loops after 65,535
// iterations of all loops together. It also counts one iteration for each loop in a branch that is not taken. On other
// devices a watchdog may end passes that take several seconds; their limits correspond to about a tenth of a second for
// a warp on a slow GPU, on which double may be 32 times slower than float. kernel.comp detects a device that ends loops
// earlier.
inline constexpr std::int64_t counted_loops = 65'000;
inline constexpr std::int64_t watched_loops_float = 1 << 18;
inline constexpr std::int64_t watched_loops_double = 1 << 15;
// Number of pixels that keeps the lanes of a CPU busy.
inline constexpr std::int64_t busy_cpu = 1 << 17;

// Returns the number of a band's cones of all levels.
inline vk::DeviceSize cones_of(const Starts& starts, int width, int rows)
{
    vk::DeviceSize tiles = 0;
    for (int pass = 0; pass < starts.cone_passes; ++pass) {
        tiles += static_cast<vk::DeviceSize>(tiles_of(width, rows, starts.cones[pass].side));
    }
    return tiles;
}

template <class Kernel>
Limits limits_of(const Scene& scene, const Kernel& kernel, const DeviceInfo& info, const RendererOptions& options)
{
    constexpr vk::DeviceSize real = sizeof(kernel.tolerance);
    // The ray buffer is the largest buffer.
    const vk::DeviceSize bytes =
        std::min<vk::DeviceSize>(info.properties.limits.maxStorageBufferRange, info.largest_allocation);
    Limits limits{.pixels_per_band =
                      std::clamp<std::int64_t>(static_cast<std::int64_t>(bytes / ray_size(real)), 1, largest_band)};
    limits.loops = {.survived = info.counts_loops ? counted_loops
                                : real == 4       ? watched_loops_float
                                                  : watched_loops_double,
                    .of_scene = loops_of(scene)};
    limits.pixels_to_fill = info.device.is_gpu ? pixels_of_gpu(info.most_invocations) : busy_cpu;
    if (cones_fit(*limits.loops)) {
        // An invocation renders one pixel and is not refilled, so neighbours do not pay. On a GPU, a second level of
        // cones would cost more DE evaluations than it saves.
        const auto [outer, inner] = info.device.is_gpu ? std::pair(gpu_cone_side, 0) : std::pair(subtile_side, 2);
        limits.starts = starts_of(kernel, *scene.fractal, options.techniques, outer, inner, false);
    }
    return with_band(limits, options.band);
}

// Runs the program of a Workbench on its buffers (see Index).
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(Gpu& gpu, Workbench& bench, const KernelScene<Real>& scene, const Starts& starts,
                 vk::DeviceSize pixels, bool bytes_alone, Timings& timings)
        : gpu_(gpu),
          bench_(bench),
          scene_(scene),
          starts_(starts),
          pixels_(pixels),
          bytes_alone_(bytes_alone),
          timings_(timings)
    {
    }

    void run(Entry entry, const Band& band, int steps) override
    {
        const Entry first = starts_.cone_passes > 0 ? Entry::cones : Entry::begin;
        if ((entry == first && band.cones.within == 0) || (entry == Entry::draw && first != Entry::cones)) {
            gpu_.commands().fillBuffer(*results().handle, 0, flags_size, 0);
            gpu_.barrier();
        }
        if (entry == Entry::cones) {
            dispatch(stage_cones, band, 0);
            gpu_.barrier();
            return;
        }
        // There is no separate pass for `begin`: the first pass that marches rays also begins them. The first pass
        // after marching also processes their stops.
        if (entry == Entry::begin) {
            begins_ = stage_begin;
            stops_ = stage_stop;
            return;
        }
        const int refining = scene_.canonical != 0 ? stage_refine : 0;
        const int stages = entry == Entry::draw     ? stage_begin | stage_march | stage_stop | refining | stage_shade
                           : entry == Entry::march  ? begins_ | stage_march
                           : entry == Entry::refine ? stops_ | stage_refine
                                                    : stops_ | stage_shade;
        const int shaded = (stages & stage_shade) != 0 && bytes_alone_ ? stage_bytes : 0;
        begins_ = 0;
        if (entry != Entry::march) stops_ = 0;
        if ((stages & stage_march) != 0) {
            gpu_.commands().fillBuffer(*results().handle, 0, flag_size, 0);
            gpu_.barrier();
        }
        dispatch(stages | shaded, band, steps);
        gpu_.barrier();
        if (shaded != 0) {
            dispatch(stage_pack, band, 0);
            gpu_.barrier();
        }
    }

    bool marching(const Band&) override
    {
        const std::byte* flag = fetch(flag_size);
        ran(gpu_.finish("marching"));
        return *reinterpret_cast<const std::int32_t*>(flag) != 0;
    }

    void read_back(const Band& band, Image& image) override
    {
        const std::size_t row = 3 * static_cast<std::size_t>(scene_.width);
        const std::size_t band_bytes = row * static_cast<std::size_t>(band.rows);
        const std::byte* bytes = fetch(bytes_alone_ ? reals_at + band_bytes : results_size(pixels_));
        ran(gpu_.finish("shading"));
        const auto start = Clock::now();
        check(bytes);
        if (bytes_alone_) {
            std::memcpy(image.row_bytes(band.first_row), bytes + reals_at, band_bytes);
            timings_.readback += seconds_since(start);
            return;
        }
        count_cones(band);
        const auto planes = planes_of(reinterpret_cast<const Real*>(bytes + reals_at),
                                      reinterpret_cast<const int*>(bytes + wholes_at(pixels_)), pixels_,
                                      static_cast<std::size_t>(scene_.width));
        image.store(planes, 0, band.first_row, scene_.width, band.rows);
        add_work(work_, planes, scene_.width, band.rows);
        timings_.readback += seconds_since(start);
    }

    const Work& work() const { return work_; }

    // Returns the byte offset of the integers in the results, for planes of `pixels` pixels.
    static vk::DeviceSize wholes_at(vk::DeviceSize pixels)
    {
        return reals_at + aligned(real_planes * sizeof(Real) * pixels);
    }
    static vk::DeviceSize wholes_size(vk::DeviceSize pixels) { return whole_planes * sizeof(int) * pixels; }
    static vk::DeviceSize results_size(vk::DeviceSize pixels) { return wholes_at(pixels) + wholes_size(pixels); }

private:
    void ran(const Took& took)
    {
        timings_.ran(took.host, took.device);
        timings_.readback += took.copies;
    }

    const Buffer& results() const { return bench_.buffers[result_buffer]; }

    // Throws Error if the second flag, set by kernel.comp, reports a ray that was cut off.
    void check(const std::byte* results) const
    {
        if (*reinterpret_cast<const std::int32_t*>(results + flag_size) == 0) return;
        throw Error(fmt::format(
            "backend vulkan: {}: the device cut a ray off in a loop, expected a device whose loops run to their end",
            gpu_.name()));
    }

    // Adds the work of the band's cones.
    void count_cones(const Band& band)
    {
        const auto* spent = reinterpret_cast<const int*>(bench_.buffers[cone_work_buffer].bytes);
        add_cone_work(work_, {spent, 2 * cones_of(starts_, scene_.width, band.rows)});
    }

    void dispatch(int stages, const Band& band, int steps)
    {
        const Program::Ints constants{stages, scene_.fractal_whole, scene_.canonical, scene_.differences};
        if (bench_.program->lacks(constants)) {
            ran(gpu_.finish("marching"));
            const auto start = Clock::now();
            // Some drivers compile a pipeline when it first runs, so it runs here without any rows.
            bench_.program->dispatch(gpu_, constants, {}, 1, 1);
            gpu_.barrier();
            gpu_.finish("compiling a shader");
            timings_.build += seconds_since(start);
        }
        const auto groups = [](int pixels, int side) { return static_cast<std::uint32_t>((pixels + side - 1) / side); };
        if (stages == stage_pack) {
            constexpr int pixels_of_group = 4 * group_side * group_side;
            bench_.program->dispatch(gpu_, constants, {band.first_row, band.rows, 0, 0},
                                     groups(scene_.width * band.rows, pixels_of_group), 1);
            return;
        }
        const bool marches_cones = stages == stage_cones;
        const Cones cones = marches_cones             ? band.cones
                            : starts_.cone_passes > 0 ? starts_.cones[starts_.cone_passes - 1]
                                                      : Cones{};
        const int of_group = marches_cones ? cones.side * group_side : group_side;
        const int pixels = marches_cones && bytes_alone_ ? 0 : static_cast<int>(pixels_);
        bench_.program->dispatch(gpu_, constants, {band.first_row, band.rows, steps, pixels, cones.side, cones.within},
                                 groups(scene_.width, of_group), groups(band.rows, of_group));
    }

    // Copies the first bytes of the results to memory that the host can read. Returns the address of the copy, which is
    // valid after the device has finished.
    const std::byte* fetch(vk::DeviceSize size)
    {
        const bool mirrored = results().bytes == nullptr;
        const Buffer& seen = mirrored ? bench_.buffers[mirror_buffer] : results();
        if (mirrored) {
            gpu_.stop_clock();
            gpu_.commands().copyBuffer(*results().handle, *seen.handle, vk::BufferCopy(0, 0, size));
            gpu_.barrier();
        }
        return seen.bytes;
    }

    Gpu& gpu_;
    Workbench& bench_;
    const KernelScene<Real>& scene_;
    const Starts& starts_;
    vk::DeviceSize pixels_;  // per plane
    bool bytes_alone_;
    Timings& timings_;
    Work work_;
    int begins_ = 0, stops_ = 0;  // stage bits that a later pass must still execute; 0: none
};

}  // namespace mandelmarch::vulkan
