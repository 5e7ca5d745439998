// SPDX-License-Identifier: Apache-2.0
// Progress of a film on stderr: a bar on a terminal, else a line every 15 s.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace mandelmarch {

// Returns hours, minutes and seconds: "1:02:03 h".
std::string clock_text(double seconds);

class FilmProgress {
public:
    // `finished`: those of the `frames` frames that earlier runs have rendered.
    FilmProgress(std::size_t frames, std::size_t finished);
    ~FilmProgress();
    FilmProgress(const FilmProgress&) = delete;
    FilmProgress& operator=(const FilmProgress&) = delete;

    // Adds finished frames of this or another process. Any thread may call it.
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
