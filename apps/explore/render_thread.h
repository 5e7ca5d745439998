// SPDX-License-Identifier: Apache-2.0
// The render thread: renders one request at a time, which can be cancelled. If a device does not respond, its thread is
// abandoned.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/explore/setup.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

using Moment = std::chrono::steady_clock::time_point;

struct RenderRequest {
    int pane = 0;
    std::uint64_t view = 0;  // version of the view
    Setup setup;
    Scene scene;
    int samples = 1;      // per pixel side
    bool moving = false;  // the camera moves: no trial
};

// A picture in the window's format: 0xFFRRGGBB, from the top row.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint32_t> of;
};

struct RenderedPicture {
    RenderRequest order;
    Pixels pixels;
    Image image;  // the original picture if it has one sample per pixel and the camera is at rest; else empty
    RenderStats report;
    double seconds = 0;   // render time
    std::string failure;  // error message; empty on success and after cancellation
    bool cancelled = false;
};

// Converts a picture to the window's format.
Pixels pixels_of(const Image& image);

class RenderThread {
public:
    // The registry must outlive all threads of the process, because abandoned threads use it.
    explicit RenderThread(const Registry& registry);
    ~RenderThread();  // cancels, and waits briefly
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    // Starts a request. Must not be called while another one is in progress.
    void draw(RenderRequest order);
    // The request in progress; nullptr: none.
    const RenderRequest* current() const { return current_ ? &*current_ : nullptr; }
    void cancel();
    // Waits for the result of the current request; nullopt if it is not available by `until`.
    std::optional<RenderedPicture> wait(Moment until);
    // Returns the finished fraction of the current request, 0 to 1.
    double progress() const;
    // Returns the seconds since the current request's last progress message; 0 without a request.
    double silence() const;
    // Abandons the thread with its request; the next request starts a new thread.
    void abandon();

private:
    struct Shared;
    static void work(const std::shared_ptr<Shared>& shared, const Registry& registry);

    const Registry& registry_;
    std::shared_ptr<Shared> shared_;
    std::optional<RenderRequest> current_;
};

}  // namespace mandelmarch::explore
