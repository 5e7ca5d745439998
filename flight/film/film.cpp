#include "flight/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <tuple>

#include "core/base/error.h"
#include "core/base/output_file.h"
#include "flight/film/encoder.h"
#include "flight/film/mp4.h"
#include "flight/film/progress.h"
#include "flight/film/title.h"
#include "flight/film/workshop.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

// Another build may draw other bits: its segments are not mixed with an earlier one's.
std::string program_digest()
{
    std::ifstream program("/proc/self/exe", std::ios::binary);
    return digest(std::string(std::istreambuf_iterator<char>(program), {}));
}

// Everything that a frame's bytes depend on.
std::string description_of(const Path& path, const Backend& backend, const FilmOptions& options)
{
    const Picture& picture = options.picture;
    const auto devices = backend.devices();
    const auto device = static_cast<std::size_t>(options.renderer.device);
    return fmt::format(
        "{{\"film\": 1, \"path\": \"{}\", \"frames\": {}, \"size\": \"{}x{}\", \"samples\": {}, \"look\": {}, "
        "\"backend\": \"{}\", \"program\": \"{}\", \"device\": \"{}\", \"precision\": \"{}\", \"mode\": \"{}\", "
        "\"title\": \"{}\", \"encoder\": \"{}\"}}\n",
        digest(to_text(path)), path.frames.size(), picture.width, picture.height, picture.samples,
        picture.look.value_or(-1), backend.name(), program_digest(),
        device < devices.size() ? devices[device].name : "", name_of(options.renderer.precision),
        name_of(options.renderer.mode), digest(options.title + "\n" + options.authors), ffmpeg_version());
}

void check(const FilmOptions& options, const Workshop& work)
{
    const Picture& picture = options.picture;
    if (picture.width % 2 != 0 || picture.height % 2 != 0 || std::min(picture.width, picture.height) < 16) {
        throw InputError(fmt::format("--size: a film of {} x {} pixels, expected even sides of at least 16",
                                     picture.width, picture.height));
    }
    if (options.segments &&
        (options.segments->second >= work.segments() || options.segments->first > options.segments->second)) {
        throw InputError(fmt::format("--segments: {}-{} given, expected some of 0-{}", options.segments->first,
                                     options.segments->second, work.segments() - 1));
    }
}

class Filming {
public:
    Filming(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks, Workshop& work)
        : path_(path), backend_(backend), options_(options), ranks_(ranks), work_(work)
    {
    }

    // Renders what is missing of the segments asked for; returns how many segments and frames these were.
    std::pair<std::size_t, std::size_t> render()
    {
        const auto [first, last] =
            options_.segments.value_or(std::pair<std::size_t, std::size_t>{0, work_.segments() - 1});
        // Rank 0 looks what is missing, so that all ranks count the same.
        std::string missing;
        std::size_t finished = 0;
        for (std::size_t s = first; s <= last; ++s) {
            if (work_.finished(s)) {
                finished += work_.last(s) - work_.first(s);
            } else {
                missing += fmt::format("{} ", s);
            }
        }
        missing = ranks_.share(missing);
        std::vector<std::size_t> todo;
        for (const char* at = missing.c_str(); *at != '\0';) {
            char* end = nullptr;
            todo.push_back(std::strtoull(at, &end, 10));
            at = end + 1;
        }
        FilmProgress progress(work_.last(last) - work_.first(first), finished);
        std::optional<FrameMaker> maker;
        if (!todo.empty()) maker.emplace(backend_, options_.renderer, path_, options_.picture);
        const bool alone = ranks_.size() == 1;
        const auto body = [&](std::size_t number) { segment(*maker, todo[number], alone ? &progress : nullptr); };
        const auto done = [&](std::size_t number) {
            // Of several ranks only whole segments are known.
            if (!alone) progress.add(work_.last(todo[number]) - work_.first(todo[number]));
        };
        ranks_.each(todo.size(), body, done);
        return {todo.size(), work_.last(last) - work_.first(first) - finished};
    }

    // Title and segments into one file, without encoding again.
    void join()
    {
        const std::string title = "title.mp4";
        std::string list;
        if (!options_.title.empty() || !options_.authors.empty()) {
            if (!fs::exists(work_.folder() + "/" + title)) {
                FrameMaker maker(backend_, options_.renderer, path_, options_.picture);
                piece(title, ".part-title.mp4", [&](const std::string& part) {
                    write_title(work_.folder(), part, maker.draw(0), options_.picture.width, options_.picture.height,
                                options_.title, options_.authors);
                });
            }
            list = fmt::format("file '{}'\n", title);
        }
        for (std::size_t s = 0; s < work_.segments(); ++s) list += fmt::format("file '{}'\n", work_.segment_file(s));
        OutputFile file(work_.folder() + "/list.txt");
        file.write(list.data(), list.size());
        file.commit();
        const std::string whole = ".part-film.mp4";
        piece("film.mp4", whole, [&](const std::string& part) {
            const auto told = run_ffmpeg({"-f",
                                          "concat",
                                          "-safe",
                                          "0",
                                          "-i",
                                          "list.txt",
                                          "-c",
                                          "copy",
                                          "-movflags",
                                          "+faststart",
                                          "-video_track_timescale",
                                          "15360",
                                          "-fflags",
                                          "+bitexact",
                                          "-progress",
                                          "pipe:1",
                                          "-stats_period",
                                          "3600",
                                          "-f",
                                          "mp4",
                                          part},
                                         work_.folder(), options_.output);
            const auto expected =
                static_cast<std::int64_t>(path_.frames.size()) + (list.starts_with("file 't") ? title_frames : 0);
            if (frames_in(told) != expected) {
                throw Error(fmt::format("{}: joined {} frames of {}", options_.output, frames_in(told), expected));
            }
        });
        std::error_code error;
        fs::rename(work_.folder() + "/film.mp4", options_.output, error);
        if (error) throw Error(fmt::format("{}: cannot rename the film to it: {}", options_.output, error.message()));
        work_.close_with(options_.output);
    }

private:
    // Lets `write` make a part and takes it as the finished file; what fails leaves nothing behind.
    template <class Write>
    void piece(const std::string& file, const std::string& part, Write write)
    {
        try {
            write(part);
            if (!whole_mp4(work_.folder() + "/" + part)) {
                throw Error(
                    fmt::format("{}/{}: ffmpeg left half a file, is there room on the disk?", work_.folder(), part));
            }
            work_.finish(part, file);
        } catch (...) {
            work_.discard(part);
            throw;
        }
    }

    void segment(FrameMaker& maker, std::size_t number, FilmProgress* progress)
    {
        piece(work_.segment_file(number), work_.part_file(number), [&](const std::string& part) {
            Encoder encoder(work_.folder(), part, options_.picture.width, options_.picture.height, "");
            for (std::size_t frame = work_.first(number); frame < work_.last(number); ++frame) {
                encoder.add(maker.draw(frame));
                if (progress != nullptr) progress->add(1);
            }
            encoder.finish();
        });
    }

    const Path& path_;
    const Backend& backend_;
    const FilmOptions& options_;
    Ranks& ranks_;
    Workshop& work_;
};

}  // namespace

FilmReport make_film(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks)
{
    const auto start = std::chrono::steady_clock::now();
    check_ffmpeg();
    Workshop work(options.output, description_of(path, backend, options), path.frames.size());
    check(options, work);
    if (ranks.rank() == 0) OutputFile::check(options.output);
    FilmReport report;
    report.segments = work.segments();
    const bool complete = !ranks.share(ranks.rank() == 0 && work.complete(options.output) ? "x" : "").empty();
    if (!complete) {
        // Array jobs work side by side in one folder.
        if (ranks.rank() == 0) work.open(options.segments.has_value());
        Filming filming(path, backend, options, ranks, work);
        std::tie(report.rendered, report.frames) = filming.render();
        if (ranks.rank() == 0 && !options.segments) filming.join();
    }
    report.joined = !options.segments;
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return report;
}

}  // namespace mandelmarch
