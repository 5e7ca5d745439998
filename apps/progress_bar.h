// SPDX-License-Identifier: Apache-2.0
// A progress bar on stderr, on a terminal only.
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
    // share: 0 to 1. `detail` follows it on the line, e.g. "round 3 of 40".
    void show(double share, const std::string& detail = "");
    // Wipes the bar.
    void finish();

private:
    std::string title_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace mandelmarch
