// SPDX-License-Identifier: Apache-2.0
// The table of keyboard commands, which the help shows, too.
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
    bool typed = false;  // a character: ignored while a panel has the keyboard
};

std::span<const Command> commands();

// Returns the key's name, such as "Ctrl+S".
std::string key_of(const Command& command);

// Executes the command of a key event. Returns false if the event is not a command.
bool take_command(Explorer& explorer, const SDL_Event& event);

}  // namespace mandelmarch::explore
