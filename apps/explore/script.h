// SPDX-License-Identifier: Apache-2.0
// Scripts that simulate the user. Their commands press keys, move the mouse and wait for results; docs/explore.md lists
// them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mandelmarch::explore {

class Explorer;

class Script {
public:
    // Reads a script. Throws InputError with a message that begins with `file:line: `.
    explicit Script(const std::string& file);

    // Executes commands until one must wait for the next frame. Called before each frame. At the end of the script,
    // makes the explorer quit.
    void step(Explorer& explorer);

private:
    struct Line {
        int number;
        std::string verb;
        std::vector<std::string> words;
    };

    // Executes a line in one frame. Returns true if the line is done, so that the next one follows in the same frame.
    bool carry_out(Explorer& explorer, const Line& line);
    int whole(const Line& line, std::size_t word, int low, int high) const;
    [[noreturn]] void fail(const Line& line, const std::string& why) const;

    std::string file_;
    std::vector<Line> lines_;
    std::size_t at_ = 0;
    int frames_ = 0;  // number of frames since the current line began
};

}  // namespace mandelmarch::explore
