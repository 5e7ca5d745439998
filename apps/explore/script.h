// SPDX-License-Identifier: Apache-2.0
// A script plays the user: keys, mouse, and waiting for what comes of them. docs/explore.md has its commands.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mandelmarch::explore {

class Explorer;

class Script {
public:
    // Throws InputError, `file:line: what is wrong`.
    explicit Script(const std::string& file);

    // Before each frame. At its end the explorer quits.
    void step(Explorer& explorer);

private:
    struct Line {
        int number;
        std::string verb;
        std::vector<std::string> words;
    };

    // True where the line is done and the next one may follow in this frame.
    bool carry_out(Explorer& explorer, const Line& line);
    int whole(const Line& line, std::size_t word, int low, int high) const;
    [[noreturn]] void fail(const Line& line, const std::string& why) const;

    std::string file_;
    std::vector<Line> lines_;
    std::size_t at_ = 0;
    int frames_ = 0;  // that the line has taken
};

}  // namespace mandelmarch::explore
