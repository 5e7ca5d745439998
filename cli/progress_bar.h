// SPDX-License-Identifier: Apache-2.0
// A progress bar on stderr. If stderr is not a terminal, nothing is printed.
#pragma once

#include <chrono>
#include <string>

namespace mandelmarch {

class ProgressBar {
public:
    // `start`: the time at which the work began.
    explicit ProgressBar(std::string title,
                         std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now());
    ~ProgressBar() { finish(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    bool on_terminal() const { return terminal_; }
    // Draws the bar, at most every 0.1 s. `share`: the finished fraction, from 0 to 1. `detail`: text after the bar,
    // such as "round 3 of 40".
    void show(double share, const std::string& detail = "");
    // Erases the bar.
    void finish();

private:
    std::string title_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace mandelmarch
