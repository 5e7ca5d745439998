// SPDX-License-Identifier: Apache-2.0
#include "apps/progress_bar.h"

#include <unistd.h>

#include "core/base/console.h"

namespace mandelmarch {
namespace {

constexpr int bar_width = 40;                              // characters
constexpr auto interval = std::chrono::milliseconds(100);  // between two looks of the bar

}  // namespace

ProgressBar::ProgressBar(std::string title)
    : title_(std::move(title)),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_)
{
}

void ProgressBar::show(double share)
{
    const auto now = std::chrono::steady_clock::now();
    if (!terminal_ || now - last_ < interval) return;
    last_ = now;
    shown_ = true;
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const double left = share > 0 ? elapsed / share - elapsed : 0;
    const int full = static_cast<int>(share * bar_width);
    say("\r{} [{:#<{}}{:.<{}}] {:3.0f} %, {:.0f} s left \033[K", title_, "", full, "", bar_width - full, 100 * share,
        left);
}

void ProgressBar::finish()
{
    if (shown_) say("\r\033[K");
    shown_ = false;
}

}  // namespace mandelmarch
