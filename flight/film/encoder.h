// SPDX-License-Identifier: Apache-2.0
// Encoding of raw frames to video files with ffmpeg.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/os/child_process.h"
#include "flight/film/container.h"
#include "flight/path/path.h"

namespace mandelmarch {

// Throws Error with a message of one line if films cannot be encoded: if ffmpeg is missing or does not respond, if it
// lacks the container's codec or the filter drawtext, or if the title's font is missing.
void check_ffmpeg(Container container);

// Returns ffmpeg's option that sets a track's time scale for `rate` frames per second.
std::vector<std::string> time_scale(int rate);

// Returns ffmpeg's version line. Two films of the same inputs are bit-identical only if this line is the same. Throws
// Error if ffmpeg fails or does not respond.
std::string ffmpeg_version();

inline constexpr double encoding_seconds = 600;  // enough for the largest frame

// A child process that reads its input from a pipe. The constructor starts the child; its output is kept. It does not
// get OpenMP's variables, because they could bind all of ffmpeg's threads to one core.
class FfmpegProcess {
public:
    // `folder`: working directory; empty: the caller's. `limit`: seconds after which the child is killed if it does not
    // read, or neither ends nor reports further frames; finish() then reports the timeout. The environment variable
    // MANDELMARCH_FFMPEG_TIMEOUT overrides it. Throws Error if the child cannot be started, InputError if the variable
    // has an invalid value.
    FfmpegProcess(const std::vector<std::string>& command, const std::string& folder, double limit = encoding_seconds);

    // Passes the data to the child. Returns false if the child has stopped reading; finish() then reports the cause.
    bool write(const void* data, std::size_t size);
    // Kills the child. A write() in another thread then returns.
    void kill() const { child_->kill(); }

    struct Result {
        std::string output;  // stdout
        std::string cause;   // in one line: an error from stderr, the signal or the exit code; empty after success
    };
    // Closes the pipe and waits for the child's end.
    Result finish();

private:
    double limit_;
    bool hung_ = false;
    Descriptor input_;
    MemoryFile output_;
    MemoryFile errors_;
    std::optional<ChildProcess> child_;
};

// The container and the frame rate of a film.
struct Coding {
    std::string film;  // its name, for messages
    Container container = Container::mp4;
    int frames_per_second = mandelmarch::frames_per_second;
};

// Encodes one segment as an MP4 file with the codec that the container uses (pixel format yuv420p, colours BT.709). The
// number of encoding threads is fixed, so that the same frames give the same bytes.
class Encoder {
public:
    // Writes `file` in `folder`. `filter`: an ffmpeg video filter that is applied to the RGB frames; may be empty.
    // `width`, `height`: pixels; must be even.
    Encoder(const std::string& folder, const std::string& file, int width, int height, const std::string& filter,
            const Coding& coding);
    ~Encoder();
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;

    // Adds one frame of RGB bytes, top row first. A background thread passes the frame to ffmpeg. Throws Error if
    // ffmpeg did not accept an earlier frame.
    void add(std::vector<std::uint8_t> frame);

    // Completes the file. Throws Error if the encoder failed or did not write all frames.
    void finish();

private:
    void wait();

    std::optional<FfmpegProcess> process_;
    std::string film_;
    std::jthread writer_;
    std::vector<std::uint8_t> frame_;
    std::int64_t frames_ = 0;
    bool broken_ = false;
};

// Runs ffmpeg with these arguments in a folder and returns its standard output. If it fails, throws Error; the message
// consists of `what` and the cause.
std::string run_ffmpeg(const std::vector<std::string>& arguments, const std::string& folder, const std::string& what);

// Returns the last number of frames in ffmpeg's progress output, or -1 if it has none.
std::int64_t frames_in(const std::string& progress);

}  // namespace mandelmarch
