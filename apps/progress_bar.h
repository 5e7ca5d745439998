// SPDX-License-Identifier: Apache-2.0
// A progress bar on stderr, on a terminal only.
#pragma once

#include <chrono>
#include <string>

namespace mandelmarch {

class ProgressBar {
public:
    explicit ProgressBar(std::string title);
    ~ProgressBar() { finish(); }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    // share: 0 to 1.
    void show(double share);
    // Wipes the bar.
    void finish();

private:
    std::string title_;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace mandelmarch
