// SPDX-License-Identifier: Apache-2.0
#include "flight/film/film.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

#include "core/os/files.h"
#include "core/os/input_file.h"
#include "core/os/output_file.h"
#include "core/os/stopwatch.h"
#include "core/os/temporary_path.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "flight/film/container.h"
#include "flight/film/description.h"
#include "flight/film/encoder.h"
#include "flight/film/progress.h"
#include "flight/film/segment_store.h"
#include "flight/film/title.h"

namespace mandelmarch {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t worth_a_forecast = 10;  // segments; the total time of fewer is not estimated
constexpr std::size_t forecast_frames = 8;    // frames rendered for the estimate
constexpr int least_side = 16;                // pixels: the minimum of libx264

// Returns a number of bytes as text, such as "1.5 GiB".
std::string size_text(double bytes)
{
    constexpr double mebi = 1 << 20;
    return bytes < 1024 * mebi ? fmt::format("{:.1f} MiB", bytes / mebi)
                               : fmt::format("{:.1f} GiB", bytes / mebi / 1024);
}

Title title_of(const FilmOptions& options) { return {options.title, options.authors}; }

// Returns the description of a film's inputs: its pictures, its encoding and its title, if any.
std::string description_of(const Path& path, const Backend& backend, const FilmOptions& options)
{
    const auto [first, last] = chosen_frames(options.frames, path.frames.size());
    return description_of(path, backend, options.picture, options.renderer,
                          {{"film of frames", fmt::format("{}-{}", first, last)},
                           {"encoding", fmt::format("{}", fmt::join(video_codec(container_of(options.output)), " "))},
                           {"title", digest(options.title)},
                           {"authors", digest(options.authors)},
                           {"font", title_of(options).empty() ? "" : digest_of_file(title_font())},
                           {"encoder", ffmpeg_version()}});
}

class Filming {
public:
    Filming(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks, SegmentStore& work)
        : path_(path),
          backend_(backend),
          options_(options),
          ranks_(ranks),
          work_(work),
          frames_(chosen_frames(options.frames, path.frames.size())),
          coding_{options.output, container_of(options.output), path.frames_per_second}
    {
    }

    // Renders those of the chosen segments that are not finished. Returns the numbers of segments and frames rendered.
    std::pair<std::size_t, std::size_t> render()
    {
        const auto [first, after] = chosen_segments(options_.segments, work_.frames());
        // Rank 0 alone looks for finished segments, so that all ranks have the same list.
        std::string found(after - first, '-');  // for each segment; x: finished
        for (std::size_t s = first; s < after && ranks_.rank() == 0; ++s) {
            if (is_finished(work_.segment_file(s))) found[s - first] = 'x';
        }
        found = ranks_.share(found);
        if (!fs::is_directory(work_.folder())) {
            throw Error(work_.folder() + ": the folder is missing on a rank, expected one that all ranks share");
        }
        std::vector<std::size_t> todo;
        std::size_t frames = 0;
        std::size_t finished = 0;
        for (std::size_t s = first; s < after; ++s) {
            frames += work_.last(s) - work_.first(s);
            if (found[s - first] == 'x') {
                finished += work_.last(s) - work_.first(s);
            } else {
                todo.push_back(s);
            }
        }
        FilmProgress progress(frames, ranks_.rank() == 0 ? finished : 0, options_.progress);
        std::optional<FrameMaker> maker;
        if (!todo.empty()) maker.emplace(backend_, options_.renderer, path_, options_.picture);
        if (ranks_.rank() == 0 && todo.size() >= worth_a_forecast) foretell(*maker, todo);
        const bool alone = ranks_.size() == 1;
        const auto body = [&](std::size_t number) { segment(*maker, todo[number], alone ? &progress : nullptr); };
        const auto done = [&](std::size_t number) {
            // With several ranks, progress is counted in finished segments, not in single frames.
            if (!alone) progress.add(work_.last(todo[number]) - work_.first(todo[number]));
        };
        ranks_.each(todo.size(), body, done);
        return {todo.size(), frames - finished};
    }

    // Joins the title and the segments to the film (without re-encoding, except for GIF) and removes the segments.
    void join()
    {
        std::vector<std::string> pieces;
        if (const Title title = title_of(options_); !title.empty()) {
            pieces.emplace_back("title.mp4");
            if (!is_finished(pieces[0])) {
                FrameMaker maker(backend_, options_.renderer, path_, options_.picture);
                piece(pieces[0], ".part-title.mp4", [&](const std::string& part) {
                    write_title(work_.folder(), part, maker.draw(frames_.first), options_.picture, title, coding_);
                });
            }
        }
        const std::size_t frames = work_.frames() + pieces.size() * title_frames(coding_.frames_per_second);
        for (std::size_t s = 0; s < work_.segments(); ++s) pieces.push_back(work_.segment_file(s));
        for (const std::string& file : pieces) {
            if (work_.state_of(file) == FileState::whole) continue;
            throw Error(fmt::format("{}/{}: changed while the film was made, expected the same command again",
                                    work_.folder(), file));
        }
        std::vector<std::string> joining{"-f", "concat", "-safe", "0", "-i", "list.txt"};
        const auto add = [&](const std::vector<std::string>& more) {
            joining.insert(joining.end(), more.begin(), more.end());
        };
        add(mandelmarch::joining(coding_.container));
        if (coding_.container == Container::mp4) add(time_scale(coding_.frames_per_second));
        // ffmpeg copies the tags of the first piece to the film if the option "-strict unofficial" is set.
        const Tags tags{options_.picture.projection == Projection::equirectangular, options_.picture.stereo};
        std::optional<TemporaryPath> tagged;
        if (!tags.none() && coding_.container != Container::gif) {
            tagged.emplace(work_.folder() + "/.part-tagged.mp4");
            tag_mp4(work_.folder() + "/" + pieces[0], tagged->path(), tags);
            pieces[0] = ".part-tagged.mp4";
            add({"-strict", "unofficial"});
        }
        add({"-fflags", "+bitexact", "-progress", "pipe:1"});
        write_file(work_.folder() + "/list.txt", fmt::format("file '{}'\n", fmt::join(pieces, "'\nfile '")),
                   NamedBy::program);
        const auto join_to = [&](const std::string& part) {
            add({part});
            const auto told = run_ffmpeg(joining, work_.folder(), options_.output);
            if (frames_in(told) != static_cast<std::int64_t>(frames)) {
                throw Error(fmt::format("{}: joined {} frames of {}", options_.output, frames_in(told), frames));
            }
            if (tags.side_by_side && coding_.container == Container::mp4) hide_vexu(work_.folder() + "/" + part);
        };
        make(".part-film", coding_.container, join_to, [&](const std::string& part) { deliver(part); });
        work_.close();
    }

private:
    // Returns true if the segment or title `file` exists and matches its stamp. Prints a message if it is damaged.
    bool is_finished(const std::string& file) const
    {
        const FileState found = work_.state_of(file);
        if (found == FileState::damaged) say("film: {}/{} is damaged and is rendered again\n", work_.folder(), file);
        return found == FileState::whole;
    }

    // Copies the joined film to the output and writes its stamp.
    void deliver(const std::string& part)
    {
        InputFile joined(work_.folder() + "/" + part, "film", NamedBy::program);
        OutputFile film(options_.output);
        Digest hash;
        for (std::string bytes; joined.next(bytes);) {
            hash.add(bytes.data(), bytes.size());
            film.write(bytes.data(), bytes.size());
        }
        film.commit();
        if (OutputFile::is_stream(options_.output)) return;
        write_note(end_of_links(options_.output), work_.made_of(), hash.text());
    }

    // Writes a file with write(part), checks that it is complete and calls take(part). The file is removed at the end
    // unless `take` has renamed it.
    template <class Write, class Take>
    void make(const std::string& part, Container container, Write write, Take take)
    {
        const TemporaryPath temporary(work_.folder() + "/" + part);
        write(part);
        if (!is_whole(temporary.path(), container)) {
            throw Error(fmt::format("{}: ffmpeg left an incomplete file, is the disk full?", options_.output));
        }
        take(part);
    }

    template <class Write>
    void piece(const std::string& file, const std::string& part, Write write)
    {
        make(part, Container::mp4, write, [&](const std::string& whole) { work_.finish(whole, file); });
    }

    // Prints an estimate of the total time, of the disk space and of the memory. To measure the time per frame, renders
    // and encodes a few frames that are spread over the film. They are encoded without regard to frames before them, so
    // a frame of the film has fewer bytes.
    void foretell(FrameMaker& maker, const std::vector<std::size_t>& todo) const
    {
        const TemporaryPath part(work_.folder() + "/" + work_.part_file(work_.segments()));
        const auto start = Clock::now();
        Encoder encoder(work_.folder(), fs::path(part.path()).filename().string(), options_.picture.width,
                        options_.picture.height, "", coding_);
        for (std::size_t i = 0; i < forecast_frames; ++i) {
            const std::size_t segment = todo[(2 * i + 1) * todo.size() / (2 * forecast_frames)];
            encoder.add(maker.draw(frames_.first + (work_.first(segment) + work_.last(segment)) / 2));
        }
        encoder.finish();
        const double each = seconds_since(start) / forecast_frames;
        const double bytes = static_cast<double>(fs::file_size(part.path())) / forecast_frames;
        std::size_t frames = 0;
        for (const std::size_t segment : todo) frames += work_.last(segment) - work_.first(segment);
        say("film: {} frames of {} x {} pixels, {:.2f} s each of {} tried: {} in all\n", frames, options_.picture.width,
            options_.picture.height, each, forecast_frames,
            clock_text(each * static_cast<double>(frames) / ranks_.size()));
        // While the segments are joined, the disk holds the segments, the joined film and, unless the output is a
        // stream, its copy. A GIF is encoded anew, so its size is not known.
        if (coding_.container == Container::gif) return;
        const int films = options_.segments ? 0 : OutputFile::is_stream(options_.output) ? 1 : 2;
        const double needed = bytes * static_cast<double>(frames + films * work_.frames());
        const double free = static_cast<double>(fs::space(work_.folder()).available);
        say("film: {}needs up to {} of disk, {} are free in {}; {} of memory\n", needed > free ? "warning: " : "",
            size_text(needed), size_text(free), work_.folder(),
            size_text(static_cast<double>(memory_of(options_.picture))));
    }

    void segment(FrameMaker& maker, std::size_t number, FilmProgress* progress)
    {
        piece(work_.segment_file(number), work_.part_file(number), [&](const std::string& part) {
            Encoder encoder(work_.folder(), part, options_.picture.width, options_.picture.height, "", coding_);
            for (std::size_t frame = work_.first(number); frame < work_.last(number); ++frame) {
                encoder.add(maker.draw(frames_.first + frame));
                if (progress != nullptr) progress->add(1);
            }
            encoder.finish();
        });
    }

    const Path& path_;
    const Backend& backend_;
    const FilmOptions& options_;
    Ranks& ranks_;
    SegmentStore& work_;
    Range frames_;
    Coding coding_;
};

// Throws Error if this rank's description differs from rank 0's, because the ranks would then render different bits.
void check_ranks(const std::string& description, Ranks& ranks)
{
    const std::string first = ranks.share(description);
    if (description == first) return;
    throw Error(
        fmt::format("rank {} would render other pictures than rank 0: {}; expected the same machines, drivers and "
                    "instruction sets (MANDELMARCH_INSTRUCTIONS can set one that all have)",
                    ranks.rank(), differences(first, description)));
}

// Prints the unfinished films of the same name that have another description, for example other options.
void name_leftovers(const SegmentStore& work, const std::string& description)
{
    for (const auto& [folder, other] : work.others()) {
        say("film: {} has {} segments of another film, which are kept: {}\n", folder, other.segments,
            differences(other.description, description));
    }
}

}  // namespace

void check_film(const FilmOptions& options, std::size_t frames, int rate)
{
    check_rate(container_of(options.output), options.output, rate);
    const Picture& picture = options.picture;
    if (picture.width % 2 != 0 || picture.height % 2 != 0 || std::min(picture.width, picture.height) < least_side) {
        throw InputError(fmt::format("--size: a film of {} x {} pixels, expected even sides of at least {}",
                                     picture.width, picture.height, least_side));
    }
    check_picture(picture);
    check_title(title_of(options), picture);
    static_cast<void>(chosen_frames(options.frames, frames));
    OutputFile::check(options.output);
    if (!OutputFile::is_stream(options.output)) {
        OutputFile::check(stamp_path(end_of_links(options.output)), NamedBy::program);
    } else if (options.segments) {
        throw InputError(fmt::format("--segments: the output {} is a pipe or device, expected a file", options.output));
    }
    // This throws if the folder for the film's segments is invalid.
    static_cast<void>(parts_folder(options.output, ""));
}

FilmStats make_film(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks)
{
    const auto start = Clock::now();
    if (ranks.rank() == 0) check_film(options, path.frames.size(), path.frames_per_second);
    check_ffmpeg(container_of(options.output));
    const std::string description = description_of(path, backend, options);
    check_ranks(description, ranks);
    const std::string made_of = digest(description);
    const bool stream = OutputFile::is_stream(options.output);
    const std::string parts = ranks.share(ranks.rank() == 0 ? parts_folder(options.output, made_of) : "");
    const auto [first, last] = chosen_frames(options.frames, path.frames.size());
    SegmentStore work(options.output, parts, description, last - first + 1);
    FilmStats report;
    report.segments = work.segments();
    const auto complete = [&] {
        return ranks.rank() == 0 && !stream && state_of(end_of_links(options.output), made_of) == FileState::whole;
    };
    if (ranks.share(complete() ? "x" : "").empty()) {
        if (ranks.rank() == 0) {
            if (stream) make_private_folder(parts);
            // The tasks of an array job (--segments) work in the same folder at the same time.
            work.open(options.segments.has_value());
            name_leftovers(work, description);
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
