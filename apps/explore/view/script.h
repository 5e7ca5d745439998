// SPDX-License-Identifier: Apache-2.0
// Scripts that simulate the user. A line is the name of an action, or a command that presses keys, moves the mouse or
// waits for results; docs/explore.md lists them.
#pragma once

#include <string>
#include <vector>

#include "apps/explore/view/explorer.h"

namespace mandelmarch::explore {

// A line of a script in a frame. `words`: the command and its arguments; `frame`: number of frames since it began.
struct ScriptLine {
    std::string place;  // "file:line"
    std::vector<std::string> words;
    int frame = 0;

    // Returns an argument from `low` to `high`. Throws InputError.
    int integer(std::size_t word, int low, int high) const;
    [[noreturn]] void fail(const std::string& why) const;
};

class Script {
public:
    // Reads a script. Throws InputError with a message that begins with `file:line: `.
    explicit Script(const std::string& file);

    // Performs lines until one must wait for the next frame. Called before each frame. At the end of the script, makes
    // explore quit.
    void step(Model& model, Window& window, Explorer& explorer);

private:
    std::vector<ScriptLine> lines_;
    std::size_t at_ = 0;
};

}  // namespace mandelmarch::explore
