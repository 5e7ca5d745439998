// SPDX-License-Identifier: Apache-2.0
// Encoding of raw frames to video files with ffmpeg.
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

// Splits options at blanks.
std::vector<std::string> words_of(const std::string& text);

// Returns the program to run: the environment variable MANDELMARCH_FFMPEG, or "ffmpeg". A path is made absolute,
// because ffmpeg runs in other folders.
std::string ffmpeg();

// Returns the seconds after which an inactive ffmpeg is killed: the environment variable MANDELMARCH_FFMPEG_TIMEOUT, or
// `usual`.
double ffmpeg_timeout(double usual);
inline constexpr double encoding_seconds = 600;  // for the largest frame on a busy machine

// Throws Error, in one line, if ffmpeg is missing or hangs, if it lacks the container's codec or drawtext, or if the
// font is missing.
void check_ffmpeg(Container container);

// Returns ffmpeg's option that sets a track's time scale for `rate` frames per second.
std::vector<std::string> time_scale(int rate);

// Returns ffmpeg's version line. Films are bit-identical only for the same version.
std::string ffmpeg_version();

// The container and the rate of a film.
struct Coding {
    Container container = Container::mp4;
    int frames_per_second = mandelmarch::frames_per_second;
};

// Encodes one segment: an MP4 file with the container's codec, yuv420p, BT.709. The number of encoding threads is
// fixed, so that the same frames give the same bytes.
class Encoder {
public:
    // Writes `file` in `folder`. `filter` is an ffmpeg video filter before the conversion, or empty. width and height:
    // pixels, even.
    Encoder(const std::string& folder, const std::string& file, int width, int height, const std::string& filter,
            const Coding& coding);
    ~Encoder();
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // Adds one frame: RGB, from the top row. A background thread passes it to ffmpeg. Throws Error if that failed for
    // an earlier frame.
    void add(std::vector<std::uint8_t> frame);

    // Throws Error if the encoder failed or did not write all frames.
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

// Runs ffmpeg with these arguments in a folder and returns its standard output. Throws Error with `what` and the cause.
std::string run_ffmpeg(const std::vector<std::string>& arguments, const std::string& folder, const std::string& what);

// Returns the final number of frames in ffmpeg's progress output, or -1.
std::int64_t frames_in(const std::string& progress);

}  // namespace mandelmarch
