// SPDX-License-Identifier: Apache-2.0
#include "flight/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "core/base/console.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/output_file.h"
#include "core/base/stopwatch.h"
#include "core/base/temporary_path.h"
#include "flight/film/description.h"
#include "flight/film/encoder.h"
#include "flight/film/mp4.h"
#include "flight/film/parts.h"
#include "flight/film/progress.h"
#include "flight/film/title.h"
#include "flight/film/workshop.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t worth_a_forecast = 10;  // segments
constexpr std::size_t forecast_frames = 8;
constexpr int least_side = 16;  // pixels: what libx264 takes

// What the film is made of: the pictures, and the title, where there is one.
std::string description_of(const Path& path, const Backend& backend, const FilmOptions& options)
{
    const bool titled = !options.title.empty() || !options.authors.empty();
    return description_of(path, backend, options.picture, options.renderer,
                          {{"title", digest(options.title)},
                           {"authors", digest(options.authors)},
                           {"font", titled ? digest_of_file(title_font()) : ""},
                           {"encoder", ffmpeg_version()}});
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
        for (std::size_t s = first; s <= last && ranks_.rank() == 0; ++s) {
            if (is_finished(work_.segment_file(s))) {
                finished += work_.last(s) - work_.first(s);
            } else {
                missing += fmt::format("{} ", s);
            }
        }
        missing = ranks_.share(missing);
        if (!fs::is_directory(work_.folder())) {
            throw Error(work_.folder() + ": it is not there, expected a folder that all ranks share");
        }
        std::vector<std::size_t> todo;
        for (const char* at = missing.c_str(); *at != '\0';) {
            char* end = nullptr;
            todo.push_back(std::strtoull(at, &end, 10));
            at = end + 1;
        }
        FilmProgress progress(work_.last(last) - work_.first(first), finished);
        std::optional<FrameMaker> maker;
        if (!todo.empty()) maker.emplace(backend_, options_.renderer, path_, options_.picture);
        if (ranks_.rank() == 0 && todo.size() >= worth_a_forecast) foretell(*maker, todo);
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
            if (!is_finished(title)) {
                FrameMaker maker(backend_, options_.renderer, path_, options_.picture);
                piece(title, ".part-title.mp4", [&](const std::string& part) {
                    write_title(work_.folder(), part, maker.draw(0), options_.picture.width, options_.picture.height,
                                options_.title, options_.authors);
                });
            }
            list = fmt::format("file '{}'\n", title);
        }
        for (std::size_t s = 0; s < work_.segments(); ++s) list += fmt::format("file '{}'\n", work_.segment_file(s));
        write_file(work_.folder() + "/list.txt", list);
        const auto join_to = [&](const std::string& part) {
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
        };
        make(".part-film.mp4", join_to, [&](const std::string& part) { deliver(part); });
        work_.close();
    }

private:
    // A piece that is there but not as it was made is named.
    bool is_finished(const std::string& file) const
    {
        const Standing found = work_.standing(file);
        if (found == Standing::damaged) say("film: {}/{} is damaged and is made again\n", work_.folder(), file);
        return found == Standing::whole;
    }

    // The joined film to where it is wanted.
    void deliver(const std::string& part)
    {
        std::ifstream joined(work_.folder() + "/" + part, std::ios::binary);
        std::string bytes(1 << 20, '\0');
        OutputFile film(options_.output);
        Digest hash;
        do {
            joined.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
            const auto count = static_cast<std::size_t>(joined.gcount());
            hash.add(bytes.data(), count);
            film.write(bytes.data(), count);
        } while (joined);
        if (!joined.eof()) throw Error(fmt::format("{}/{}: it cannot be read", work_.folder(), part));
        film.commit();
        if (OutputFile::is_stream(options_.output)) return;
        write_note(end_of_links(options_.output), work_.made_of(), hash.text());
    }

    // Lets `write` make a part, looks whether it is whole and lets `take` have it; what fails leaves nothing behind.
    template <class Write, class Take>
    void make(const std::string& part, Write write, Take take)
    {
        const TemporaryPath temporary(work_.folder() + "/" + part);
        write(part);
        if (!whole_mp4(temporary.path())) {
            throw Error(fmt::format("{}: ffmpeg left half a file, is there room on the disk?", temporary.path()));
        }
        take(part);
    }

    template <class Write>
    void piece(const std::string& file, const std::string& part, Write write)
    {
        make(part, write, [&](const std::string& whole) { work_.finish(whole, file); });
    }

    // How long it will take, from a few frames between the first and the last, drawn and encoded.
    void foretell(FrameMaker& maker, const std::vector<std::size_t>& todo) const
    {
        const TemporaryPath part(work_.folder() + "/" + work_.part_file(work_.segments()));
        const auto start = Clock::now();
        Encoder encoder(work_.folder(), fs::path(part.path()).filename().string(), options_.picture.width,
                        options_.picture.height, "");
        for (std::size_t i = 0; i < forecast_frames; ++i) {
            const std::size_t segment = todo[(2 * i + 1) * todo.size() / (2 * forecast_frames)];
            encoder.add(maker.draw((work_.first(segment) + work_.last(segment)) / 2));
        }
        encoder.finish();
        const double each = seconds_since(start) / forecast_frames;
        std::size_t frames = 0;
        for (const std::size_t segment : todo) frames += work_.last(segment) - work_.first(segment);
        say("film: {} frames of {} x {} pixels, {:.2f} s each of {} tried: {} in all\n", frames, options_.picture.width,
            options_.picture.height, each, forecast_frames,
            clock_text(each * static_cast<double>(frames) / ranks_.size()));
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

void check_film(const FilmOptions& options, std::size_t frames)
{
    const Picture& picture = options.picture;
    if (picture.width % 2 != 0 || picture.height % 2 != 0 || std::min(picture.width, picture.height) < least_side) {
        throw InputError(fmt::format("--size: a film of {} x {} pixels, expected even sides of at least {}",
                                     picture.width, picture.height, least_side));
    }
    check_picture(picture);
    if (options.segments) check_segments(*options.segments, frames);
    OutputFile::check(options.output);
    if (!OutputFile::is_stream(options.output)) {
        OutputFile::check(note_of(end_of_links(options.output)));
    } else if (options.segments) {
        throw InputError(
            fmt::format("--segments: {} is no file beside which segments gather, expected a file", options.output));
    }
    // Whether there is a folder for its parts.
    static_cast<void>(parts_folder(options.output, ""));
}

FilmReport make_film(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks)
{
    const auto start = Clock::now();
    if (ranks.rank() == 0) check_film(options, path.frames.size());
    check_ffmpeg();
    const std::string description = description_of(path, backend, options);
    const std::string made_of = digest(description);
    const bool stream = OutputFile::is_stream(options.output);
    const std::string parts = ranks.share(ranks.rank() == 0 ? parts_folder(options.output, made_of) : "");
    Workshop work(options.output, parts, description, path.frames.size());
    FilmReport report;
    report.segments = work.segments();
    const auto complete = [&] {
        return ranks.rank() == 0 && !stream && standing(end_of_links(options.output), made_of) == Standing::whole;
    };
    if (ranks.share(complete() ? "x" : "").empty()) {
        if (ranks.rank() == 0) {
            if (stream) make_private_folder(parts);
            // Array jobs work side by side in one folder.
            work.open(options.segments.has_value());
        }
        Filming filming(path, backend, options, ranks, work);
        std::tie(report.rendered, report.frames) = filming.render();
        if (ranks.rank() == 0 && !options.segments) filming.join();
    }
    report.joined = !options.segments;
    report.seconds = seconds_since(start);
    return report;
}

}  // namespace mandelmarch
