// SPDX-License-Identifier: Apache-2.0
// Prints the progress of a film to stderr: a bar if stderr is a terminal, else a line every 15 s.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace mandelmarch {

// Returns a time as hours, minutes and seconds, such as "1:02:03 h".
std::string clock_text(double seconds);

class FilmProgress {
public:
    // `frames`: number of frames in all. `finished`: number of those that earlier runs have rendered.
    FilmProgress(std::size_t frames, std::size_t finished);
    ~FilmProgress();
    FilmProgress(const FilmProgress&) = delete;
    FilmProgress& operator=(const FilmProgress&) = delete;

    // Adds a number of finished frames, rendered by this or another process. May be called from any thread.
    void add(std::size_t frames);

private:
    void show();

    std::mutex guard_;
    std::size_t frames_, finished_, drawn_ = 0;
    bool terminal_;
    bool shown_ = false;
    std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace mandelmarch
