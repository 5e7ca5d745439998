// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/view/input.h"

#include <array>
#include <cmath>
#include <utility>

namespace mandelmarch::explore {
namespace {

constexpr double dead_zone = 0.15;  // deflections of a stick (0 to 1) below this are ignored

struct Held {
    SDL_Keycode key;
    Vector way, turn;
};

// The keys are the same as in the report's viewer.
constexpr std::array keys{
    Held{SDLK_w, {0, 0, 1}, {}},     Held{SDLK_s, {0, 0, -1}, {}},    Held{SDLK_a, {-1, 0, 0}, {}},
    Held{SDLK_d, {1, 0, 0}, {}},     Held{SDLK_r, {0, 1, 0}, {}},     Held{SDLK_f, {0, -1, 0}, {}},
    Held{SDLK_LEFT, {}, {-1, 0, 0}}, Held{SDLK_RIGHT, {}, {1, 0, 0}}, Held{SDLK_UP, {}, {0, 1, 0}},
    Held{SDLK_DOWN, {}, {0, -1, 0}}, Held{SDLK_q, {}, {0, 0, -1}},    Held{SDLK_e, {}, {0, 0, 1}},
};

}  // namespace

void Input::let_go()
{
    held_.clear();
    dragging_ = false;
}

void Input::take(const SDL_Event& event, bool over_panel, bool in_panel, double radians)
{
    switch (event.type) {
        case SDL_KEYDOWN:
            if (!in_panel && (event.key.keysym.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)) == 0)
                held_.insert(event.key.keysym.sym);
            break;
        case SDL_KEYUP: held_.erase(event.key.keysym.sym); break;
        case SDL_MOUSEBUTTONDOWN: dragging_ = !over_panel; break;
        case SDL_MOUSEBUTTONUP: dragging_ = false; break;
        case SDL_MOUSEMOTION:
            if (!dragging_) break;
            yaw_ += radians * event.motion.xrel;
            pitch_ -= radians * event.motion.yrel;
            break;
        case SDL_MOUSEWHEEL:
            if (!over_panel) notches_ += event.wheel.y;
            break;
        case SDL_WINDOWEVENT:
            if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) let_go();
            break;
        case SDL_CONTROLLERDEVICEADDED:
            if (pad_ == nullptr) pad_.reset(SDL_GameControllerOpen(event.cdevice.which));
            break;
        case SDL_CONTROLLERDEVICEREMOVED:
            if (pad_ != nullptr && SDL_GameControllerFromInstanceID(event.cdevice.which) == pad_.get()) pad_.reset();
            break;
        default: break;
    }
}

double Input::axis(SDL_GameControllerAxis axis) const
{
    const double value = pad_ != nullptr ? SDL_GameControllerGetAxis(pad_.get(), axis) / 32767.0 : 0;
    return std::abs(value) < dead_zone ? 0 : value;
}

MotionInput Input::wish()
{
    MotionInput wish;
    for (const Held& known : keys) {
        if (!held_.contains(known.key)) continue;
        wish.way = wish.way + known.way;
        wish.turn = wish.turn + known.turn;
    }
    const auto button = [&](SDL_GameControllerButton which) {
        return pad_ != nullptr && SDL_GameControllerGetButton(pad_.get(), which) != 0 ? 1.0 : 0.0;
    };
    wish.way = wish.way + Vector{axis(SDL_CONTROLLER_AXIS_LEFTX),
                                 axis(SDL_CONTROLLER_AXIS_TRIGGERRIGHT) - axis(SDL_CONTROLLER_AXIS_TRIGGERLEFT),
                                 -axis(SDL_CONTROLLER_AXIS_LEFTY)};
    wish.turn =
        wish.turn + Vector{axis(SDL_CONTROLLER_AXIS_RIGHTX), -axis(SDL_CONTROLLER_AXIS_RIGHTY),
                           button(SDL_CONTROLLER_BUTTON_RIGHTSHOULDER) - button(SDL_CONTROLLER_BUTTON_LEFTSHOULDER)};
    wish.yaw = std::exchange(yaw_, 0);
    wish.pitch = std::exchange(pitch_, 0);
    return wish;
}

double Input::take_notches() { return std::exchange(notches_, 0); }

}  // namespace mandelmarch::explore
