// SPDX-License-Identifier: Apache-2.0
#include "flight/film/encoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "core/base/error.h"
#include "core/base/number.h"
#include "flight/film/ffmpeg_process.h"
#include "flight/film/title.h"

namespace mandelmarch {
namespace {

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

std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

std::string ffmpeg()
{
    const char* named = std::getenv("MANDELMARCH_FFMPEG");
    if (named == nullptr || *named == '\0') return "ffmpeg";
    // A name without a slash stays as it is and is searched in PATH.
    const std::string name = named;
    return name.find('/') == std::string::npos ? name : std::filesystem::absolute(name).string();
}

double ffmpeg_timeout(double usual)
{
    constexpr double longest = 1e6;  // seconds; its milliseconds fit into the int that poll() takes
    const char* text = std::getenv("MANDELMARCH_FFMPEG_TIMEOUT");
    const double seconds = text == nullptr ? usual : parse_real(text).value_or(usual);
    return seconds > 0 ? std::min(seconds, longest) : usual;
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
                              "", ffmpeg_timeout(check_seconds));
        const auto result = process.finish();
        if (!result.cause.empty()) throw Error(result.cause);
    } catch (const Error& error) {
        throw Error(fmt::format("{} does not work: {}; films need ffmpeg with {} and drawtext", ffmpeg(), error.what(),
                                codec[1]));
    }
}

std::string ffmpeg_version()
{
    FfmpegProcess process({ffmpeg(), "-version"}, "", ffmpeg_timeout(check_seconds));
    const std::string text = process.finish().output;
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

struct Encoder::Pipe {
    FfmpegProcess process;
};

Encoder::Encoder(const std::string& folder, const std::string& file, int width, int height, const std::string& filter,
                 const Coding& coding)
    : file_(file)
{
    const auto input =
        words_of(fmt::format("-f rawvideo -pix_fmt rgb24 -video_size {}x{} -framerate {} -i - -progress pipe:1 "
                             "-stats_period 3600 -vf",
                             width, height, coding.frames_per_second));
    const std::string filters = (filter.empty() ? "" : filter + ",") + std::string(conversion);
    auto command = joined(quietly(), input, std::vector{filters}, video_codec(coding.container), encoding(),
                          time_scale(coding.frames_per_second), std::vector{file});
    std::erase(command, "-nostdin");
    pipe_.reset(new Pipe{.process = {command, folder, ffmpeg_timeout(encoding_seconds)}});
}

Encoder::~Encoder()
{
    // The writer may be blocked in write(); killing the child makes it return.
    if (writer_.joinable()) {
        pipe_->process.kill();
        writer_.join();
    }
}

void Encoder::wait()
{
    if (writer_.joinable()) writer_.join();
    if (!broken_) return;
    const auto result = pipe_->process.finish();
    throw Error(fmt::format("{}: the encoder failed: {}", file_,
                            result.cause.empty() ? "it stopped reading frames" : result.cause));
}

void Encoder::add(std::vector<std::uint8_t> frame)
{
    wait();
    frame_ = std::move(frame);
    ++frames_;
    writer_ = std::jthread([this] { broken_ = !pipe_->process.write(frame_.data(), frame_.size()); });
}

void Encoder::finish()
{
    wait();
    const auto result = pipe_->process.finish();
    if (!result.cause.empty()) throw Error(fmt::format("{}: the encoder failed: {}", file_, result.cause));
    if (frames_in(result.output) != frames_) {
        throw Error(fmt::format("{}: the encoder wrote {} frames of {}", file_, frames_in(result.output), frames_));
    }
}

}  // namespace mandelmarch
