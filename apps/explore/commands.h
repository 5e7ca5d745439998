// SPDX-License-Identifier: Apache-2.0
// What a key does, once a press: one table, which the help shows, too.
#pragma once

#include <SDL.h>

#include <span>
#include <string>

namespace mandelmarch::explore {

class Explorer;

struct Command {
    SDL_Keycode key;
    bool control;
    const char* what;
    void (*act)(Explorer& explorer);
    bool typed = false;  // a letter: it goes to a panel that has the keyboard
};

std::span<const Command> commands();

// "Ctrl+S"
std::string key_of(const Command& command);

// True where the event was one of them, and has been carried out.
bool take_command(Explorer& explorer, const SDL_Event& event);

}  // namespace mandelmarch::explore
