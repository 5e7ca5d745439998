// SPDX-License-Identifier: Apache-2.0
#include "cli/progress_bar.h"

#include <unistd.h>

#include "core/base/console.h"

namespace mandelmarch {
namespace {

constexpr int bar_width = 40;                              // characters
constexpr auto interval = std::chrono::milliseconds(100);  // between updates

}  // namespace

ProgressBar::ProgressBar(std::string title, std::chrono::steady_clock::time_point start)
    : title_(std::move(title)), terminal_(isatty(STDERR_FILENO) != 0), start_(start), last_(start - interval)
{
}

void ProgressBar::show(double share, const std::string& detail)
{
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || now - last_ < interval) return;
    last_ = now;
    shown_ = true;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const std::string left = share > 0 ? fmt::format(", {:.0f} s left", elapsed / share - elapsed) : "";
    // If there is a detail, the bar is shorter, so that the line fits into 80 columns.
    const int width = detail.empty() ? bar_width : bar_width / 2;
    const int full = static_cast<int>(share * width);
    say("\r{} [{:#<{}}{:.<{}}] {:3.0f} %{}{}{} \033[K", title_, "", full, "", width - full, 100 * share,
        detail.empty() ? "" : ", ", detail, left);
}

void ProgressBar::finish()
{
    if (shown_) say("\r\033[K");
    shown_ = false;
}

}  // namespace mandelmarch
