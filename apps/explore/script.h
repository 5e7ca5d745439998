// SPDX-License-Identifier: Apache-2.0
// Scripts that simulate the user: keys, mouse, and waiting for results. docs/explore.md lists the commands.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mandelmarch::explore {

class Explorer;

class Script {
public:
    // Throws InputError with a message that begins with `file:line: `.
    explicit Script(const std::string& file);

    // Executes commands; called before each frame. Quits the explorer at the end of the script.
    void step(Explorer& explorer);

private:
    struct Line {
        int number;
        std::string verb;
        std::vector<std::string> words;
    };

    // Executes a line for one frame. Returns true if it is done, so that the next one may follow in the same frame.
    bool carry_out(Explorer& explorer, const Line& line);
    int whole(const Line& line, std::size_t word, int low, int high) const;
    [[noreturn]] void fail(const Line& line, const std::string& why) const;

    std::string file_;
    std::vector<Line> lines_;
    std::size_t at_ = 0;
    int frames_ = 0;  // frames that the current line has taken
};

}  // namespace mandelmarch::explore
