// SPDX-License-Identifier: Apache-2.0
// Runs bands of the schedule on a device.
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <vector>

#include "backends/opencl/device.h"
#include "backends/opencl/session.h"
#include "core/image/tile.h"
#include "core/os/stopwatch.h"
#include "core/render/kernel_scene.h"
#include "core/render/schedule.h"

namespace mandelmarch::opencl {

// Height of a strip in cells of a lattice; must equal MM_STRIP in strip.cl.
inline constexpr int strip_height = 16;

// Renders bands with the session's buffers.
template <class Real>
class BandExecutor : public Executor {
public:
    BandExecutor(Session& session, cl::Program& program, const Build& build, const Scene& scene,
                 const RendererOptions& options, const Limits& limits, bool bytes_alone)
        : session_(session),
          kernel_(program, "draw_band"),
          lanes_(build.lanes),
          block_(options.block_size),
          width_(scene.width),
          pixels_(Image::pixels(scene.width, rows_per_band(scene, limits))),
          cone_side_(limits.starts.tile_side()),
          bytes_alone_(bytes_alone),
          scene_(kernel_scene<KernelScene<Real>>(scene, options.mode, options.techniques))
    {
        const Clock::time_point start = Clock::now();
        const cl_mem_flags flags = CL_MEM_READ_WRITE | (session.is_cpu ? CL_MEM_ALLOC_HOST_PTR : 0);
        constants_ = session.constants.of_size(session.context, CL_MEM_READ_ONLY, sizeof(scene_));
        // Every kernel argument must be set, so buffers that this picture does not need hold one value.
        const std::size_t planes = bytes_alone ? 1 : pixels_;
        reals_ = session.reals.of_size(session.context, flags, reals_size(planes));
        wholes_ = session.wholes.of_size(session.context, flags, wholes_size(planes));
        bytes_ = session.bytes.of_size(session.context, flags, bytes_alone ? 3 * pixels_ : 1);
        const std::size_t tiles = cone_side_ > 0 ? cones_in(rows_per_band(scene, limits)) : 1;
        starts_ = session.starts.of_size(session.context, flags, tiles * sizeof(Real));
        cone_work_ = session.cone_work.of_size(session.context, flags, 2 * tiles * sizeof(int));
        const std::size_t depths = limits.starts.lattices.count > 1 ? pixels_ / 2 + 1 : 1;
        depths_ = session.depths.of_size(session.context, flags, depths * sizeof(Real));
        if (cone_side_ > 0) cones_ = cl::Kernel(program, "march_cones");
        session.queue.enqueueWriteBuffer(constants_, CL_TRUE, 0, sizeof(scene_), &scene_);
        timings.upload = seconds_since(start);
    }

    // Launches the kernel on the largest band but with no rows to render, because some drivers compile a kernel at its
    // first launch.
    void warm_up()
    {
        const int rows = static_cast<int>(pixels_) / width_;
        if (cone_side_ > 0) march_cones({0, 0}, rows);
        draw({0, 0}, rows);
        wait_for(launched_, "compiling");
        launched_.clear();
    }

    void run(Entry entry, const Band& band, int) override
    {
        if (launched_.empty()) start_ = Clock::now();
        entry == Entry::cones ? march_cones(band, band.rows) : draw(band, band.rows);
    }

    bool marching(const Band&) override { return false; }

    // Waits for all kernels of the band at once, because a wait takes about as long as a small kernel.
    void read_back(const Band& band, Image& image) override
    {
        wait_for(launched_, "drawing");
        timings.ran(seconds_since(start_), device_seconds(launched_));
        launched_.clear();
        const Clock::time_point start = Clock::now();
        if (bytes_alone_) {
            const std::size_t row = 3 * static_cast<std::size_t>(width_);
            const std::size_t size = row * static_cast<std::size_t>(band.rows);
            std::uint8_t* to = image.row_bytes(band.first_row);
            if (session_.is_cpu) {
                void* bytes = mapped(bytes_, size);
                std::memcpy(to, bytes, size);
                session_.queue.enqueueUnmapMemObject(bytes_, bytes);
            } else {
                session_.queue.enqueueReadBuffer(bytes_, CL_TRUE, 0, size, to);
            }
        } else if (session_.is_cpu) {
            void* reals = mapped(reals_, reals_size(pixels_));
            void* wholes = mapped(wholes_, wholes_size(pixels_));
            store(static_cast<const Real*>(reals), static_cast<const int*>(wholes), band, image);
            session_.queue.enqueueUnmapMemObject(reals_, reals);
            session_.queue.enqueueUnmapMemObject(wholes_, wholes);
        } else {
            void* reals = session_.host_reals.of_size(session_.context, session_.queue, reals_size(pixels_));
            void* wholes = session_.host_wholes.of_size(session_.context, session_.queue, wholes_size(pixels_));
            session_.queue.enqueueReadBuffer(reals_, CL_FALSE, 0, reals_size(pixels_), reals);
            session_.queue.enqueueReadBuffer(wholes_, CL_TRUE, 0, wholes_size(pixels_), wholes);
            store(static_cast<const Real*>(reals), static_cast<const int*>(wholes), band, image);
        }
        if (!bytes_alone_ && cone_side_ > 0) count_cones(band);
        timings.readback += seconds_since(start);
    }

    Timings timings;
    Work work;

private:
    static std::size_t reals_size(std::size_t pixels) { return real_planes * sizeof(Real) * pixels; }
    static std::size_t wholes_size(std::size_t pixels) { return whole_planes * sizeof(int) * pixels; }

    // Returns the number of tiles with cones in `rows` rows.
    std::size_t cones_in(int rows) const { return static_cast<std::size_t>(tiles_of(width_, rows, cone_side_)); }

    void count_cones(const Band& band)
    {
        std::vector<int> spent(2 * cones_in(band.rows));
        session_.queue.enqueueReadBuffer(cone_work_, CL_TRUE, 0, sizeof(int) * spent.size(), spent.data());
        add_cone_work(work, spent);
    }

    // Launches the kernel of cones. A work item marches the cones of one vector.
    void march_cones(const Band& band, int rows_covered)
    {
        const auto lanes = static_cast<std::size_t>(lanes_);
        cones_.setArg(0, constants_);
        cones_.setArg(1, band.first_row);
        cones_.setArg(2, band.rows);
        cones_.setArg(3, cone_side_);
        cones_.setArg(4, starts_);
        cones_.setArg(5, cone_work_);
        // On a CPU, a core takes one group after another.
        const std::size_t group = session_.is_cpu ? 1 : 64;
        const std::size_t groups = (cones_in(rows_covered) + lanes * group - 1) / (lanes * group);
        launch(cones_, cl::NDRange(groups * group), cl::NDRange(group));
    }

    // Launches the kernel of pixels.
    void draw(const Band& band, int rows_covered)
    {
        // With vectors, a work item renders a strip of cells (strip.cl). On a CPU each work group has one such item,
        // because a core takes one group after another. Without vectors, a work group renders a square of
        // pixels.
        const int side_of_group = !session_.is_cpu ? 8 : lanes_ > 1 ? 1 : tile_side;
        const int group_width = block_ > 0 ? 8 : side_of_group;
        const int group_height = block_ > 0 ? block_ / group_width : side_of_group;
        const int cell = cell_side(band.lattice);
        const int columns = tiles_along(width_, cell);
        const int lines = tiles_along(rows_covered, cell);
        const int item_width = lanes_ > 1 ? strip_width(std::int64_t{columns} * lines) : 1;
        const int item_height = lanes_ > 1 ? strip_height : 1;
        const auto items = [](int pixels, int of_item, int of_group) {
            const int count = (pixels + of_item * of_group - 1) / (of_item * of_group);
            return static_cast<std::size_t>(count) * static_cast<std::size_t>(of_group);
        };
        const std::size_t all_columns = items(columns, item_width, group_width);
        const std::size_t all_lines = items(lines, item_height, group_height);
        kernel_.setArg(0, constants_);
        kernel_.setArg(1, band.first_row);
        kernel_.setArg(2, band.rows);
        kernel_.setArg(3, static_cast<cl_long>(pixels_));
        kernel_.setArg(4, reals_);
        kernel_.setArg(5, wholes_);
        kernel_.setArg(6, bytes_);
        kernel_.setArg(7, bytes_alone_ ? 1 : 0);
        kernel_.setArg(8, item_width);
        kernel_.setArg(9, starts_);
        kernel_.setArg(10, cone_side_ > 0 ? std::countr_zero(static_cast<unsigned>(cone_side_)) : -1);
        kernel_.setArg(11, depths_);
        kernel_.setArg(12, band.lattice.before);
        kernel_.setArg(13, band.lattice.apart);
        // With vectors, draw_band() permutes the rows of work groups, whose number must be a power of two.
        launch(kernel_, cl::NDRange(all_columns, lanes_ > 1 ? std::bit_ceil(all_lines) : all_lines),
               cl::NDRange(static_cast<std::size_t>(group_width), static_cast<std::size_t>(group_height)));
    }

    void launch(const cl::Kernel& kernel, const cl::NDRange& all, const cl::NDRange& group)
    {
        session_.queue.enqueueNDRangeKernel(kernel, cl::NullRange, all, group, nullptr, &launched_.emplace_back());
        session_.queue.flush();
    }

    // Returns the width of a strip in cells. While the last rays of a strip march, most lanes are idle, which costs
    // less per pixel in a wide strip. The width gives about 32 strips per compute unit, so that few cores are idle
    // while the last strips are rendered.
    int strip_width(std::int64_t cells) const
    {
        constexpr std::int64_t strips_of_unit = 32;
        constexpr std::int64_t least = 32;  // a multiple of every block's width
        constexpr std::int64_t most = 256;
        const auto strips = strips_of_unit * session_.device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
        const std::int64_t width = cells / (strips * strip_height);
        return static_cast<int>(std::clamp(width / least * least, least, most));
    }

    // Maps a buffer of a CPU device and returns its address. This makes no copy, because the buffer lies in host
    // memory.
    void* mapped(const cl::Buffer& buffer, std::size_t bytes)
    {
        return session_.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, bytes);
    }

    void store(const Real* reals, const int* wholes, const Band& band, Image& image)
    {
        const auto planes = planes_of(reals, wholes, pixels_, static_cast<std::size_t>(width_));
        image.store(planes, 0, band.first_row, width_, band.rows);
        add_work(work, planes, width_, band.rows);
    }

    Session& session_;
    std::vector<cl::Event> launched_;  // the kernels of the band, for which nothing has waited yet
    Clock::time_point start_;          // when the first of them was launched
    cl::Kernel kernel_;
    cl::Kernel cones_;
    int lanes_;
    int block_;  // RendererOptions::block_size
    int width_;
    std::size_t pixels_;  // per plane of the buffers
    int cone_side_;       // side of the tiles with cones; 0: there are none
    bool bytes_alone_;
    KernelScene<Real> scene_;
    cl::Buffer constants_;
    cl::Buffer reals_;
    cl::Buffer wholes_;
    cl::Buffer bytes_;
    cl::Buffer starts_;
    cl::Buffer cone_work_;
    cl::Buffer depths_;
};

}  // namespace mandelmarch::opencl
