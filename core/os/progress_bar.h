// SPDX-License-Identifier: Apache-2.0
// Progress on stderr: a bar if stderr is a terminal; otherwise a line every 15 s if ProgressOptions::lines is true,
// else nothing.
#pragma once

#include <string>

#include "core/os/stopwatch.h"

namespace mandelmarch {

// Returns a time as hours, minutes and seconds, such as "1:02:03 h".
std::string clock_text(double seconds);

struct ProgressOptions {
    Clock::time_point start = Clock::now();  // the time at which the work began
    double share = 0;                        // share of the work that was already finished at that time
    bool lines = false;                      // prints lines if stderr is not a terminal
};

class ProgressBar {
public:
    explicit ProgressBar(std::string title, const ProgressOptions& options = {});
    ~ProgressBar() { finish(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    bool on_terminal() const { return terminal_; }
    // Draws the bar, at most every 0.1 s. `share`: the finished share of the work, from 0 to 1. `detail`: text after
    // the bar, such as "round 3 of 40".
    void show(double share, const std::string& detail = "");
    // Erases the bar.
    void finish();

private:
    std::string title_;
    ProgressOptions options_;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point last_;
};

}  // namespace mandelmarch
