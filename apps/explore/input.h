// SPDX-License-Identifier: Apache-2.0
// Input: converts keys held down, the mouse and a game pad to motion.
#pragma once

#include <SDL.h>

#include <set>

#include "apps/explore/motion.h"

namespace mandelmarch::explore {

class Input {
public:
    ~Input();
    Input() = default;
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;

    // `over_panel`, `in_panel`: a panel has the mouse or the keyboard. `radians`: angle of a pixel.
    void take(const SDL_Event& event, bool over_panel, bool in_panel, double radians);
    // Returns the motion since the last call, without the wheel.
    MotionInput wish();
    // Returns the notches of the wheel since the last call.
    double take_notches();
    bool dragging() const { return dragging_; }
    void let_go();

private:
    double axis(SDL_GameControllerAxis axis) const;

    std::set<SDL_Keycode> held_;
    bool dragging_ = false;
    double yaw_ = 0, pitch_ = 0, notches_ = 0;
    SDL_GameController* pad_ = nullptr;
};

}  // namespace mandelmarch::explore
