// SPDX-License-Identifier: Apache-2.0
// The render thread. It renders one request at a time; a request can be cancelled. If a device does not respond, the
// thread can be abandoned. The next request then starts a new thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/explore/model/files.h"
#include "core/render/registry.h"

namespace mandelmarch::explore {

using Moment = std::chrono::steady_clock::time_point;

struct RenderRequest {
    int pane = 0;
    std::uint64_t view = 0;  // version of the view that `scene` shows
    Setup setup;
    Scene scene;
    int samples = 1;      // per pixel side
    bool moving = false;  // the camera moves; the picture is rendered without a trial
};

// A picture in the window's format: 0xFFRRGGBB, top row first.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint32_t> of;
};

struct RenderedPicture {
    RenderRequest order;
    Pixels pixels;
    Image image;  // the picture as rendered, if it has one sample per pixel and the camera is at rest; else empty
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
    ~RenderThread();  // cancels the request and waits for the thread's end, but for 50 ms at most
    RenderThread(const RenderThread&) = delete;
    RenderThread& operator=(const RenderThread&) = delete;

    // Starts a request. Must not be called while another one is in progress.
    void draw(RenderRequest order);
    // Returns the request in progress, or nullptr if there is none.
    const RenderRequest* current() const { return current_ ? &*current_ : nullptr; }
    void cancel();
    // Waits for the result of the current request. Returns nullopt if it is not complete at the time `until`.
    std::optional<RenderedPicture> wait(Moment until);
    // Returns the time in seconds since the last progress message of the current request; 0 without a request.
    double silence() const;
    // Abandons the thread together with its request. The next request starts a new thread.
    void abandon();

private:
    struct Shared;
    static void work(const std::shared_ptr<Shared>& shared, const Registry& registry);

    const Registry& registry_;
    std::shared_ptr<Shared> shared_;
    std::optional<RenderRequest> current_;
};

}  // namespace mandelmarch::explore
