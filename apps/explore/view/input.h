// SPDX-License-Identifier: Apache-2.0
// Converts the user's input (keys that are held down, the mouse and a game pad) to motion.
#pragma once

#include <SDL.h>

#include <memory>
#include <set>

#include "apps/explore/model/motion.h"

namespace mandelmarch::explore {

class Input {
public:
    // Processes an event. `over_panel`: a panel uses the mouse. `in_panel`: a panel uses the keyboard. `radians`: the
    // angle by which the camera turns if the mouse is dragged by one pixel.
    void take(const SDL_Event& event, bool over_panel, bool in_panel, double radians);
    // Returns the requested motion. It includes all dragging of the mouse since the last call.
    MotionInput wish();
    // Returns the notches by which the wheel has been turned since the last call.
    double take_notches();
    // Treats all keys and buttons as released.
    void let_go();

private:
    double axis(SDL_GameControllerAxis axis) const;

    std::set<SDL_Keycode> held_;
    bool dragging_ = false;
    double yaw_ = 0, pitch_ = 0, notches_ = 0;
    std::unique_ptr<SDL_GameController, void (*)(SDL_GameController*)> pad_{nullptr, SDL_GameControllerClose};
};

}  // namespace mandelmarch::explore
