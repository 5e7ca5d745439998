// SPDX-License-Identifier: Apache-2.0
// Raw frames into a finished piece of film, with ffmpeg.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "flight/film/container.h"
#include "flight/path/path.h"

namespace mandelmarch {

// The program: MANDELMARCH_FFMPEG in the environment (a path is made absolute, as it runs in other folders), or ffmpeg.
std::string ffmpeg();

// Seconds that ffmpeg may do nothing: MANDELMARCH_FFMPEG_TIMEOUT in the environment, or `usual`.
double ffmpeg_timeout(double usual);
inline constexpr double encoding_seconds = 600;  // for the largest frame on a busy machine

// Throws Error, in one line, if ffmpeg is missing, does not answer, or lacks something that films need: the container's
// codec, drawtext or the font.
void check_ffmpeg(Container container);

// ffmpeg's scale of time for `rate` frames a second, as an option.
std::vector<std::string> time_scale(int rate);

// What ffmpeg says of its version: frames are promised to be the same for the same one.
std::string ffmpeg_version();

// The container and the rate of a film.
struct Coding {
    Container container = Container::mp4;
    int frames_per_second = mandelmarch::frames_per_second;
};

// One segment: an MP4 file of the container's codec, yuv420p, BT.709, always with the same number of threads so that
// the same frames give the same bytes.
class Encoder {
public:
    // Writes `file` in `folder`. `filter` is an ffmpeg video filter before the conversion, or empty. width and height:
    // pixels, even.
    Encoder(const std::string& folder, const std::string& file, int width, int height, const std::string& filter,
            const Coding& coding);
    ~Encoder();
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // One frame, RGB, from the top row. It is handed over while the caller draws the next: throws Error where an
    // earlier one failed.
    void add(std::vector<std::uint8_t> frame);

    // Throws Error where the encoder failed or counts another number of frames than were added.
    void finish();

private:
    struct Pipe;
    void wait();

    std::unique_ptr<Pipe> pipe_;
    std::string file_;
    std::jthread writer_;
    std::vector<std::uint8_t> frame_;
    std::int64_t frames_ = 0;
    bool broken_ = false;
};

// Runs ffmpeg with these arguments in a folder. Throws Error with `what` and the cause.
std::string run_ffmpeg(const std::vector<std::string>& arguments, const std::string& folder, const std::string& what);

// The number of frames that ffmpeg's progress output ends with.
std::int64_t frames_in(const std::string& progress);

}  // namespace mandelmarch
