// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/view/render_thread.h"

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "core/os/stopwatch.h"
#include "core/text/error.h"
#include "flight/film/frames.h"

namespace mandelmarch::explore {

struct RenderThread::Shared {
    std::mutex mutex;
    std::condition_variable changed;
    std::optional<RenderRequest> order;
    std::optional<RenderedPicture> drawn;
    std::stop_source stop;
    bool ends = false;
    bool ended = false;
    std::atomic<Clock::rep> heard = 0;

    void hear() { heard = Clock::now().time_since_epoch().count(); }
};

namespace {

constexpr auto parting = std::chrono::milliseconds(50);  // time that the destructor waits for the thread

// Converts rows of red, green and blue bytes to pixels. `top`: the top row. `row`: bytes from one row to the row below.
Pixels pixels_of_rows(const std::uint8_t* top, std::ptrdiff_t row, int width, int height)
{
    Pixels pixels{width, height, std::vector<std::uint32_t>(Image::pixels(width, height))};
    auto to = pixels.of.begin();
    for (std::ptrdiff_t y = 0; y < height; ++y) {
        const std::uint8_t* rgb = top + y * row;
        for (int x = 0; x < width; ++x, rgb += 3) {
            *to++ = 0xFF000000U | static_cast<std::uint32_t>(rgb[0]) << 16 | static_cast<std::uint32_t>(rgb[1]) << 8 |
                    rgb[2];
        }
    }
    return pixels;
}

// Renders requests. Keeps its renderers and its picture, so that later requests can reuse them.
class Easel {
public:
    explicit Easel(const Registry& registry) : registry_(registry) {}

    void draw(RenderedPicture& drawn, const Progress& progress)
    {
        const RenderRequest& order = drawn.order;
        const Clock::time_point start = Clock::now();
        Scene scene = order.scene;
        scene.width *= order.samples;
        scene.height *= order.samples;
        Renderer& renderer = renderer_of(order);
        if (image_.width() != scene.width || image_.height() != scene.height) {
            image_ = Image(scene.width, scene.height, Image::Layers::bytes);
        }
        drawn.report = renderer.render(scene, image_, progress);
        if (order.samples == 1) {
            drawn.pixels = pixels_of(image_);
            if (!order.moving) drawn.image = image_;
        } else {
            const auto [width, height] = std::pair(order.scene.width, order.scene.height);
            drawn.pixels = pixels_of_rows(shrunk(image_, width, height, 0).data(), 3L * width, width, height);
        }
        drawn.seconds = seconds_since(start);
    }

    // Discards the renderers of a setup. Called after a failure.
    void forget(const Setup& setup)
    {
        std::erase_if(renderers_, [&](const auto& known) { return known.first.first == setup; });
    }

private:
    Renderer& renderer_of(const RenderRequest& order)
    {
        auto& renderer = renderers_[{order.setup, order.moving}];
        if (renderer != nullptr) return *renderer;
        const Backend& backend = backend_of(registry_, order.setup);
        // unavailable() throws the driver's error if the driver failed when its devices were listed.
        if (const auto why = backend.unavailable()) throw Unavailable(order.setup.backend + ": " + *why);
        const RendererOptions options = options_of(order.setup);
        renderer = backend.create(order.moving ? without_trial(options) : options);
        return *renderer;
    }

    const Registry& registry_;
    std::map<std::pair<Setup, bool>, std::unique_ptr<Renderer>> renderers_;
    Image image_;
};

}  // namespace

Pixels pixels_of(const Image& image)
{
    const std::ptrdiff_t row = 3L * image.width();
    return pixels_of_rows(image.bytes().data() + row * (image.height() - 1), -row, image.width(), image.height());
}

RenderThread::RenderThread(const Registry& registry) : registry_(registry) {}

RenderThread::~RenderThread()
{
    const auto left = shared_;
    abandon();
    if (left == nullptr) return;
    std::unique_lock lock(left->mutex);
    left->changed.wait_for(lock, parting, [&left] { return left->ended; });
}

void RenderThread::work(const std::shared_ptr<Shared>& shared, const Registry& registry)
{
    {
        Easel easel(registry);
        std::unique_lock lock(shared->mutex);
        for (;;) {
            shared->changed.wait(lock, [&] { return shared->ends || shared->order; });
            if (shared->ends) break;
            RenderedPicture drawn{
                .order = std::move(*shared->order), .pixels = {}, .image = {}, .report = {}, .failure = {}};
            shared->order.reset();
            const std::stop_token stop = shared->stop.get_token();
            lock.unlock();
            try {
                easel.draw(drawn, Progress([&](double) { shared->hear(); }, stop));
            } catch (const Cancelled&) {
                drawn.cancelled = true;
            } catch (const std::exception& error) {
                drawn.failure = error.what();
                easel.forget(drawn.order.setup);
            }
            lock.lock();
            shared->drawn = std::move(drawn);
            shared->changed.notify_all();
        }
    }
    const std::scoped_lock lock(shared->mutex);
    shared->ended = true;
    shared->changed.notify_all();
}

void RenderThread::draw(RenderRequest order)
{
    if (shared_ == nullptr) {
        shared_ = std::make_shared<Shared>();
        // The thread is detached, because a driver that does not respond could block it for ever.
        std::thread([shared = shared_, &registry = registry_] { work(shared, registry); }).detach();
    }
    const std::scoped_lock lock(shared_->mutex);
    current_ = order;
    shared_->hear();
    shared_->stop = std::stop_source();
    shared_->order = std::move(order);
    shared_->changed.notify_all();
}

void RenderThread::cancel()
{
    if (!current_) return;
    const std::scoped_lock lock(shared_->mutex);
    shared_->stop.request_stop();
}

std::optional<RenderedPicture> RenderThread::wait(Moment until)
{
    if (!current_) return std::nullopt;
    std::unique_lock lock(shared_->mutex);
    if (!shared_->changed.wait_until(lock, until, [this] { return shared_->drawn.has_value(); })) return std::nullopt;
    std::optional<RenderedPicture> drawn = std::move(shared_->drawn);
    shared_->drawn.reset();
    current_.reset();
    return drawn;
}

double RenderThread::silence() const
{
    if (!current_) return 0;
    return seconds_since(Clock::time_point(Clock::duration(shared_->heard.load())));
}

void RenderThread::abandon()
{
    const auto left = std::exchange(shared_, nullptr);
    current_.reset();
    if (left == nullptr) return;
    const std::scoped_lock lock(left->mutex);
    left->ends = true;
    left->stop.request_stop();
    left->changed.notify_all();
}

}  // namespace mandelmarch::explore
