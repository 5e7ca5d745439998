// SPDX-License-Identifier: Apache-2.0
// Draws in a thread of its own: one order at a time, which can be cancelled. A device that does not come back is left
// behind with its thread.
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

struct Order {
    int pane = 0;
    std::uint64_t view = 0;  // number of the view that it shows
    Setup setup;
    Scene scene;
    int samples = 1;      // on a side of a pixel
    bool moving = false;  // no trial chooses its steps, which only a picture at rest is worth
};

// Pixels as a window takes them: 0xFFRRGGBB, from the top row.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint32_t> of;
};

struct Drawn {
    Order order;
    Pixels pixels;
    Image image;  // the whole picture itself, of one sample a pixel at rest; else empty
    RenderReport report;
    double seconds = 0;   // that the order took
    std::string failure;  // why there are no pixels; empty also where it was cancelled
    bool cancelled = false;
};

// A picture's bytes for a window.
Pixels pixels_of(const Image& image);

class Painter {
public:
    // The registry outlives the process's last thread.
    explicit Painter(const Registry& registry);
    ~Painter();  // cancels, and waits no longer than a moment
    Painter(const Painter&) = delete;
    Painter& operator=(const Painter&) = delete;

    // Only while nothing is being drawn.
    void draw(Order order);
    // What is being drawn; nullptr: nothing.
    const Order* current() const { return current_ ? &*current_ : nullptr; }
    void cancel();
    // What has been drawn; nullopt where it is not there at that moment.
    std::optional<Drawn> wait(Moment until);
    // The finished share of what is being drawn, 0 to 1.
    double progress() const;
    // Seconds since the drawing thread was last heard of; 0 where nothing is being drawn.
    double silence() const;
    // Leaves the thread with what it draws behind; the next order has a new one.
    void abandon();

private:
    struct Shared;
    static void work(const std::shared_ptr<Shared>& shared, const Registry& registry);

    const Registry& registry_;
    std::shared_ptr<Shared> shared_;
    std::optional<Order> current_;
};

}  // namespace mandelmarch::explore
