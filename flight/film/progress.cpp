// SPDX-License-Identifier: Apache-2.0
#include "flight/film/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "core/base/console.h"

namespace mandelmarch {
namespace {

constexpr int bar_width = 40;                          // characters
constexpr auto look = std::chrono::milliseconds(200);  // between updates of the bar
constexpr auto line = std::chrono::seconds(15);        // between lines if stderr is not a terminal

}  // namespace

std::string clock_text(double seconds)
{
    const auto whole = std::llround(std::max(seconds, 0.0));
    return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

FilmProgress::FilmProgress(std::size_t frames, std::size_t finished)
    : frames_(frames),
      finished_(finished),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_)
{
    if (finished > 0) say("film: {} of {} frames are already rendered\n", finished, frames);
}

FilmProgress::~FilmProgress()
{
    if (shown_) say("\r\033[K");
}

void FilmProgress::add(std::size_t frames)
{
    const std::scoped_lock lock(guard_);
    drawn_ += frames;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < (terminal_ ? std::chrono::milliseconds(look) : std::chrono::milliseconds(line))) return;
    last_ = now;
    show();
}

void FilmProgress::show()
{
    const double elapsed = std::chrono::duration<double>(last_ - start_).count();
    const double rate = static_cast<double>(drawn_) / elapsed;
    const std::size_t done = finished_ + drawn_;
    const double left = rate > 0 ? static_cast<double>(frames_ - std::min(frames_, done)) / rate : 0;
    const std::string text =
        fmt::format("{} of {} frames, {:.2f} frames/s, {} left", done, frames_, rate, clock_text(left));
    if (!terminal_) {
        say("film: {}\n", text);
        return;
    }
    shown_ = true;
    const int full =
        static_cast<int>(static_cast<double>(bar_width) * static_cast<double>(done) / static_cast<double>(frames_));
    say("\rfilm [{:#<{}}{:.<{}}] {} \033[K", "", std::min(full, bar_width), "", bar_width - std::min(full, bar_width),
        text);
}

}  // namespace mandelmarch
