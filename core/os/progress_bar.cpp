// SPDX-License-Identifier: Apache-2.0
#include "core/os/progress_bar.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/text/console.h"

namespace mandelmarch {
namespace {

constexpr int bar_width = 40;         // characters
constexpr double bar_interval = 0.1;  // seconds between updates of the bar
constexpr double line_interval = 15;  // seconds between lines
constexpr double long_time = 1000;    // seconds; longer times are printed with hours and minutes

}  // namespace

std::string clock_text(double seconds)
{
    const auto whole = std::llround(std::max(seconds, 0.0));
    return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

ProgressBar::ProgressBar(std::string title, const ProgressOptions& options)
    : title_(std::move(title)), options_(options), terminal_(isatty(STDERR_FILENO) != 0)
{
    if (!terminal_) last_ = options.start;  // delays the first line by line_interval; a bar is shown at once
}

void ProgressBar::show(double share, const std::string& detail)
{
    if (!terminal_ && !options_.lines) return;
    if (seconds_since(last_) < (terminal_ ? bar_interval : line_interval)) return;
    last_ = Clock::now();
    std::string text = fmt::format("{:3.0f} %", 100 * share);
    if (!detail.empty()) text += ", " + detail;
    if (share > options_.share) {
        const double left = seconds_since(options_.start) * (1 - share) / (share - options_.share);
        text += left < long_time ? fmt::format(", {:.0f} s left", left) : fmt::format(", {} left", clock_text(left));
    }
    if (!terminal_) {
        say("{}: {}\n", title_, text);
        return;
    }
    shown_ = true;
    // If there is a detail, the bar is shorter, so that the line fits into 80 columns.
    const int width = detail.empty() ? bar_width : bar_width / 2;
    const int full = std::clamp(static_cast<int>(share * width), 0, width);
    say("\r{} [{:#<{}}{:.<{}}] {} \033[K", title_, "", full, "", width - full, text);
}

void ProgressBar::finish()
{
    if (shown_) say("\r\033[K");
    shown_ = false;
}

}  // namespace mandelmarch
