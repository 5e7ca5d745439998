// SPDX-License-Identifier: Apache-2.0
// The table of keyboard commands. The help is made from it, too.
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
    bool typed = false;  // the key types a character or acts on panels; ignored while a panel has the keyboard
};

std::span<const Command> commands();

// Returns the name of the command's key, such as "Ctrl+S".
std::string key_of(const Command& command);

// Executes the command that belongs to an event. Returns false if the event is not the key of a command.
bool take_command(Explorer& explorer, const SDL_Event& event);

}  // namespace mandelmarch::explore
