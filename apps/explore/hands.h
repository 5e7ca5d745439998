// SPDX-License-Identifier: Apache-2.0
// Keys held down, the mouse and a game pad, as wishes of motion.
#pragma once

#include <SDL.h>

#include <set>

#include "apps/explore/motion.h"

namespace mandelmarch::explore {

class Hands {
public:
    ~Hands();
    Hands() = default;
    Hands(const Hands&) = delete;
    Hands& operator=(const Hands&) = delete;

    // `over_panel`, `in_panel`: the mouse, or the keyboard, belongs to a panel. `radians`: of a pixel.
    void take(const SDL_Event& event, bool over_panel, bool in_panel, double radians);
    // Since the last one. A wheel's notches come by `notches`.
    Wish wish();
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
