// SPDX-License-Identifier: Apache-2.0
// Tests the renderer of core/models with a fake programming model, which records the calls to its device.
#include <gtest/gtest.h>

#include <set>

#include "core/models/model.h"
#include "core/render/kernel_scene.h"
#include "tests/scenes.h"

namespace mandelmarch {
namespace {

constexpr double device_seconds = 7;  // duration of each launch by the fake device's clock

// A fake kernel. Sets every byte of the rows to 200, but the second byte to the number of warps that render, and the
// third to the number of pixels taken, which it then changes. Does not change layers other than the bytes.
void draw(std::span<const job::Task> tasks)
{
    const auto& job = *static_cast<const job::KernelArguments<layout_f32::Scene, float>*>(tasks.front().job);
    if (job.bytes == nullptr) return;
    std::fill_n(job.bytes, 3L * job.scene.width * job.rows, static_cast<unsigned char>(200));
    job.bytes[1] = static_cast<unsigned char>(tasks.front().threads / job::warp_threads);
    job.bytes[2] = static_cast<unsigned char>((*job.taken)++);
}

// The calls that the fake model has received.
struct Calls {
    int allocations = 0;
    int launches = 0;
    int current = 0;  // selections that live
    std::set<void*> held;
    bool outside = false;  // a device call was made outside the device's thread
};

class Counting : public job::Model {
public:
    explicit Counting(Calls& calls, int multiprocessors = 0) : calls_(calls), multiprocessors_(multiprocessors) {}

    std::string_view name() const override { return "counting"; }
    BackendInfo info() const override { return {}; }
    job::Kernels kernels() const override
    {
        return {[](std::string_view) -> job::DrawKernel* { return draw; }, nullptr};
    }
    job::OpenedDevice open(int) const override
    {
        return {.pixels_per_band = 100, .multiprocessors = multiprocessors_, .resident_warps = 4};
    }
    job::Selection select(const RendererOptions&) const override
    {
        ++calls_.current;
        return std::shared_ptr<int>(&calls_.current, [](int* current) { --*current; });
    }
    double seconds_of(const std::function<void()>& launch) const override
    {
        ++calls_.launches;
        launch();
        return device_seconds;
    }
    void* allocate(std::size_t bytes) const override
    {
        ++calls_.allocations;
        calls_.outside |= calls_.current == 0;
        return *calls_.held.insert(Model::allocate(bytes)).first;
    }
    void release(void* address) const override
    {
        calls_.outside |= calls_.current == 0;
        calls_.held.erase(address);
        Model::release(address);
    }

private:
    Calls& calls_;
    int multiprocessors_;
};

class KernelArguments : public testing::Test {
protected:
    Timings drawn(Renderer& renderer, int width, int height)
    {
        Image image(width, height, Image::Layers::bytes);
        const Timings timings = renderer.render(official_scene("bulb", width, height), image).timings;
        EXPECT_EQ(image.bytes().front(), 200);
        EXPECT_EQ(image.bytes().back(), 200);
        return timings;
    }
    std::unique_ptr<Renderer> created(int band = 0)
    {
        return backend_->create({.precision = Precision::f32, .band = band, .counts = false});
    }

    Calls calls_;
    std::unique_ptr<Backend> backend_ = job::backend_of(std::make_unique<Counting>(calls_));
};

TEST_F(KernelArguments, ARendererKeepsItsMemoryFromPictureToPicture)
{
    const auto renderer = created();
    drawn(*renderer, 20, 20);
    const int taken = calls_.allocations;
    EXPECT_GT(taken, 0);
    drawn(*renderer, 20, 20);
    drawn(*renderer, 10, 10);
    EXPECT_EQ(calls_.allocations, taken);
    drawn(*renderer, 200, 20);  // a single row is larger than the band for which memory was allocated
    EXPECT_GT(calls_.allocations, taken);
}

TEST_F(KernelArguments, MemoryIsReleasedOnItsDevice)
{
    drawn(*created(), 20, 20);
    EXPECT_TRUE(calls_.held.empty());
    EXPECT_FALSE(calls_.outside);
}

TEST_F(KernelArguments, KernelTimeIsByTheDevicesClock)
{
    const Timings timings = drawn(*created(), 20, 20);
    EXPECT_EQ(calls_.launches, 4);
    EXPECT_EQ(timings.kernel, 4 * device_seconds);
    EXPECT_LT(timings.host, device_seconds);
}

// As many warps render as are resident at once, but not more than there are tiles of 8 x 4 pixels, rounded up to whole
// blocks; if the number of multiprocessors is unknown, one for each of these tiles.
TEST_F(KernelArguments, ResidentWarpsRender)
{
    for (const auto& [multiprocessors, rendering] : {std::pair{1, 4}, {1000, 8}, {0, 8}}) {
        const auto backend = job::backend_of(std::make_unique<Counting>(calls_, multiprocessors));
        Image image(10, 20, Image::Layers::bytes);
        backend->create({.precision = Precision::f32, .counts = false})->render(official_scene("box", 10, 20), image);
        EXPECT_EQ(image.bytes()[1], rendering);
    }
}

TEST_F(KernelArguments, EachBandBeginsWithAllItsPixels)
{
    Image image(10, 20, Image::Layers::bytes);
    created()->render(official_scene("box", 10, 20), image);
    EXPECT_EQ(image.bytes()[2], 0);
    EXPECT_EQ(image.bytes()[3 * 10 * 10 + 2], 0) << "second band";
}

TEST_F(KernelArguments, BandsHaveTheSizeOfTheOption)
{
    drawn(*created(200), 20, 20);
    EXPECT_EQ(calls_.launches, 2);
}

}  // namespace
}  // namespace mandelmarch
