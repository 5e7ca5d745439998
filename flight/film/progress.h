// SPDX-License-Identifier: Apache-2.0
// How far a film is, on stderr: a bar on a terminal, else a line now and then.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace mandelmarch {

// Hours, minutes and seconds: "1:02:03 h".
std::string clock_text(double seconds);

class FilmProgress {
public:
    // `frames`: of the film; `finished`: of them, by earlier runs.
    FilmProgress(std::size_t frames, std::size_t finished);
    ~FilmProgress();
    FilmProgress(const FilmProgress&) = delete;
    FilmProgress& operator=(const FilmProgress&) = delete;

    // More frames are done: drawn by this process, or told by another. Any thread may call it.
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
