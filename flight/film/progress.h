// SPDX-License-Identifier: Apache-2.0
// Counts the finished frames of a film and prints the progress to stderr.
#pragma once

#include <fmt/format.h>

#include <functional>

#include "core/os/progress_bar.h"
#include "core/text/console.h"

namespace mandelmarch {

class FilmProgress {
public:
    // `frames`: number of frames in all. `finished`: number of those that earlier runs have rendered. `to`: receives
    // the finished share of the film, too; may be empty.
    FilmProgress(std::size_t frames, std::size_t finished, std::function<void(double)> to = {})
        : frames_(static_cast<double>(frames)),
          finished_(static_cast<double>(finished)),
          to_(std::move(to)),
          bar_("film", {.start = start_, .share = finished_ / frames_, .lines = true})
    {
        if (finished > 0) say("film: {} of {} frames are already rendered\n", finished, frames);
    }

    // Adds a number of finished frames, rendered by this or another process.
    void add(std::size_t frames)
    {
        drawn_ += static_cast<double>(frames);
        const double done = finished_ + drawn_;
        if (to_) to_(done / frames_);
        bar_.show(done / frames_, fmt::format("{:.0f} of {:.0f} frames, {:.2f} frames/s", done, frames_,
                                              drawn_ / seconds_since(start_)));
    }

private:
    Clock::time_point start_ = Clock::now();
    double frames_, finished_, drawn_ = 0;
    std::function<void(double)> to_;
    ProgressBar bar_;
};

}  // namespace mandelmarch
