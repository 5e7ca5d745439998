// SPDX-License-Identifier: Apache-2.0
#include "flight/film/encoder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "core/text/environment.h"
#include "core/text/error.h"
#include "core/text/number.h"
#include "flight/film/title.h"

namespace mandelmarch {
namespace {

constexpr std::size_t last_progress = 1 << 12;  // bytes; ffmpeg's last reports of progress

constexpr const char* no_space = "No space left on device";

// Returns the line of ffmpeg's errors that names the cause. If one of the lines says that the disk is full, it is that
// message, otherwise the first line, because later lines are more general.
std::string cause_of(const std::string& errors)
{
    if (errors.find(no_space) != std::string::npos) return no_space;
    const std::size_t begin = std::min(errors.find_first_not_of('\n'), errors.size());
    return errors.substr(begin, errors.find('\n', begin) - begin);
}

// Splits options at blanks.
std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

// Returns the name or path of ffmpeg: the value of the environment variable MANDELMARCH_FFMPEG, or "ffmpeg" if it is
// not set.
std::string ffmpeg()
{
    const std::string name = environment_variable("MANDELMARCH_FFMPEG");
    return name.empty() ? "ffmpeg" : name;
}

// Returns ffmpeg's options for the encoded file. bitexact leaves out metadata that changes from run to run.
std::vector<std::string> encoding()
{
    return words_of(
        "-threads 4 -pix_fmt yuv420p -g 60 -flags:v +bitexact -fflags +bitexact -colorspace bt709 "
        "-color_primaries bt709 -color_trc bt709 -color_range tv -f mp4");
}

constexpr const char* conversion =
    "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int+bitexact,format=yuv420p";

template <class... Lists>
std::vector<std::string> joined(std::vector<std::string> first, const Lists&... more)
{
    (first.insert(first.end(), more.begin(), more.end()), ...);
    return first;
}

constexpr double check_seconds = 30;

std::vector<std::string> quietly() { return joined({ffmpeg()}, words_of("-hide_banner -nostdin -loglevel error -y")); }

}  // namespace

FfmpegProcess::FfmpegProcess(const std::vector<std::string>& command, const std::string& folder, double limit)
    : limit_(environment_seconds("MANDELMARCH_FFMPEG_TIMEOUT", limit))
{
    auto [theirs, ours] = make_pipe();
    fcntl(ours.number(), F_SETFL, O_NONBLOCK);
    child_.emplace(ChildSetup{.words = command,
                              .folder = folder,
                              .input = theirs.number(),
                              .output = output_.number(),
                              .errors = errors_.number(),
                              .hidden = {"OMP_", "GOMP_", "KMP_"}});
    input_ = std::move(ours);
}

bool FfmpegProcess::write(const void* data, std::size_t size)
{
    const char* next = static_cast<const char*>(data);
    while (size > 0) {
        pollfd pipe{.fd = input_.number(), .events = POLLOUT, .revents = 0};
        const int ready = poll(&pipe, 1, static_cast<int>(std::ceil(std::min(1e3 * limit_, 1e9))));
        if (ready == 0) {
            hung_ = true;
            kill();
            return false;
        }
        const ssize_t written = ::write(input_.number(), next, size);
        if (written < 0 && errno != EINTR && errno != EAGAIN) return false;
        if (written <= 0) continue;
        next += written;
        size -= static_cast<std::size_t>(written);
    }
    return true;
}

FfmpegProcess::Result FfmpegProcess::finish()
{
    input_ = Descriptor();
    std::int64_t before = -1;
    while (!child_->ends_within(limit_)) {
        const std::int64_t frames = frames_in(output_.text(last_progress));
        if (frames == before) break;
        before = frames;
    }
    const Ended& ended = child_->end(0);
    Result result{.output = output_.text(), .cause = cause_of(errors_.text())};
    if (hung_ || ended.timed_out) {
        result.cause = fmt::format("no answer in {:.6g} s", limit_);
    } else if (ended.code == 0 && result.cause != no_space) {
        result.cause.clear();  // not if the disk was full: ffmpeg may then return 0, too
    } else if (ended.signal != 0 || result.cause.empty()) {
        result.cause = ended.text();
    }
    return result;
}

std::vector<std::string> time_scale(int rate)
{
    constexpr int ticks = 512;  // units of time per frame
    return {"-video_track_timescale", fmt::format("{}", ticks * rate)};
}

void check_ffmpeg(Container container)
{
    if (!std::filesystem::exists(title_font())) {
        throw Error(fmt::format("the font {} for the title is missing, install fonts-dejavu-core", title_font()));
    }
    const std::string filter = fmt::format("drawtext={}:text=x,{}", font_option(), conversion);
    const std::vector<std::string> codec = video_codec(container);
    try {
        FfmpegProcess process(joined(quietly(), words_of("-f lavfi -i color=s=64x64:r=30:d=0.1 -vf"),
                                     std::vector{filter}, codec, words_of("-f null -")),
                              "", check_seconds);
        const auto result = process.finish();
        if (!result.cause.empty()) throw Error(result.cause);
    } catch (const InputError&) {
        throw;
    } catch (const Error& error) {
        throw Error(fmt::format("{} does not work: {}; films need ffmpeg with {} and drawtext", ffmpeg(), error.what(),
                                codec[1]));
    }
}

std::string ffmpeg_version()
{
    FfmpegProcess process({ffmpeg(), "-version"}, "", check_seconds);
    const auto [text, cause] = process.finish();
    if (!cause.empty()) throw Error(fmt::format("{} -version: {}", ffmpeg(), cause));
    return text.substr(0, text.find(" Copyright"));
}

std::string run_ffmpeg(const std::vector<std::string>& arguments, const std::string& folder, const std::string& what)
{
    FfmpegProcess process(joined(quietly(), arguments), folder);
    const auto result = process.finish();
    if (!result.cause.empty()) throw Error(fmt::format("{}: ffmpeg failed: {}", what, result.cause));
    return result.output;
}

std::int64_t frames_in(const std::string& progress)
{
    const auto at = progress.rfind("frame=");
    if (at == std::string::npos) return -1;
    std::string number = progress.substr(at + 6, progress.find('\n', at) - at - 6);
    number.erase(0, number.find_first_not_of(' '));
    return parse_whole(number).value_or(-1);
}

Encoder::Encoder(const std::string& folder, const std::string& file, int width, int height, const std::string& filter,
                 const Coding& coding)
    : film_(coding.film)
{
    const auto input =
        words_of(fmt::format("-f rawvideo -pix_fmt rgb24 -video_size {}x{} -framerate {} -i - -progress pipe:1 "
                             "-stats_period 3600 -vf",
                             width, height, coding.frames_per_second));
    const std::string filters = (filter.empty() ? "" : filter + ",") + std::string(conversion);
    auto command = joined(quietly(), input, std::vector{filters}, video_codec(coding.container), encoding(),
                          time_scale(coding.frames_per_second), std::vector{file});
    std::erase(command, "-nostdin");
    process_.emplace(command, folder);
}

Encoder::~Encoder()
{
    // The writer may be blocked in write(); killing the child makes write() return.
    if (writer_.joinable()) {
        process_->kill();
        writer_.join();
    }
}

void Encoder::wait()
{
    if (writer_.joinable()) writer_.join();
    if (!broken_) return;
    const auto result = process_->finish();
    throw Error(fmt::format("{}: the encoder failed: {}", film_,
                            result.cause.empty() ? "it stopped reading frames" : result.cause));
}

void Encoder::add(std::vector<std::uint8_t> frame)
{
    wait();
    frame_ = std::move(frame);
    ++frames_;
    writer_ = std::jthread([this] { broken_ = !process_->write(frame_.data(), frame_.size()); });
}

void Encoder::finish()
{
    wait();
    const auto result = process_->finish();
    if (!result.cause.empty()) throw Error(fmt::format("{}: the encoder failed: {}", film_, result.cause));
    if (frames_in(result.output) != frames_) {
        throw Error(fmt::format("{}: the encoder wrote {} frames of {}", film_, frames_in(result.output), frames_));
    }
}

}  // namespace mandelmarch
