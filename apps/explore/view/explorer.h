// SPDX-License-Identifier: Apache-2.0
// The main loop: passes the user's input to the model, renders the view and shows it.
#pragma once

#include <functional>
#include <string>

#include "apps/explore/model/model.h"
#include "apps/explore/view/input.h"
#include "apps/explore/view/panes.h"
#include "apps/explore/view/window.h"

namespace mandelmarch::explore {

class Explorer {
public:
    Explorer(Model& model, Window& window);

    // Shows frames until the user quits. Calls `before_frame` before each frame. At the end, stores the settings in the
    // model.
    void run(const std::function<void()>& before_frame);

    // Returns true if the camera rests and its picture is complete.
    bool at_rest() const { return !moving_ && !panes_.missing() && !panes_.drawing(); }
    // Returns the state as one line of JSON.
    std::string state() const;

private:
    void tick();
    void take_events();
    bool take_key(const SDL_Event& event);
    void arrange();
    void move(double seconds);
    double budget() const;
    void show_panels();
    void show();
    void wait_if_idle();

    Model& model_;
    Window& window_;
    Panes panes_;
    Input input_;
    bool moving_ = false;
    bool flew_ = false;
    bool focus_ = false;  // the keyboard moves to the panel
    std::uint64_t frame_ = 0;
    float panel_width_ = 0;      // pixels
    SDL_Rect area_{0, 0, 1, 1};  // part of the window for pictures
    std::uint64_t seen_ = 0;     // version of the view at whose eye `clearance_` was computed
    double clearance_ = 0;
    double showing_ = 0.004;  // average time of a frame that is not spent on rendering, in seconds
    Moment last_{}, due_{};
};

}  // namespace mandelmarch::explore
