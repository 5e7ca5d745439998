// SPDX-License-Identifier: Apache-2.0
// Scripts that simulate the user, for tests. A line is the name of an action (actions.h), or one of three commands:
// `hold KEY FRAMES` holds a key, `rest` waits until all work has ended, and `tell` prints the state as a line of JSON.
#pragma once

#include <functional>
#include <string>

#include "apps/explore/view/explorer.h"

namespace mandelmarch::explore {

// Performs a script's lines up to one that must wait for the next frame. Must be called before each frame. Makes
// explore quit at the end of the script.
using Script = std::function<void(Model& model, Window& window, Explorer& explorer)>;

// Reads a script. Throws InputError with a message that begins with `file:line: `.
Script read_script(const std::string& file);

}  // namespace mandelmarch::explore
