// SPDX-License-Identifier: Apache-2.0
// Renders a path as a film or as still pictures.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/render/backend.h"
#include "flight/film/frames.h"
#include "flight/film/ranks.h"
#include "flight/path/path.h"

namespace mandelmarch {

// A range of indices, both ends included.
using Range = std::pair<std::size_t, std::size_t>;

struct FilmOptions {
    std::string output = "video.mp4";
    std::string title;    // first line before the flight; empty: none
    std::string authors;  // second line
    Picture picture;
    RendererOptions renderer;
    // For array jobs: renders only segments [first, second], without those beyond the film's end, and does not join.
    std::optional<Range> segments;
    // The frames [first, second] of the path that become the film; all if not set.
    std::optional<Range> frames;
};

// Statistics of make_film().
struct FilmStats {
    std::size_t segments = 0;  // in the film
    std::size_t rendered = 0;  // segments rendered in this run, by all ranks
    std::size_t frames = 0;    // frames in these segments
    double seconds = 0;
    bool joined = false;  // the film is complete
};

// Returns the chosen frames of a path with `all` frames, by default all. Throws InputError if the path does not have
// all of them.
Range chosen_frames(const std::optional<Range>& frames, std::size_t all);

// Returns the chosen segments of a film with `frames` frames, by default all, without those beyond its end. Throws
// InputError if the film has none of them.
Range chosen_segments(const std::optional<Range>& segments, std::size_t frames);

// Throws InputError if a film cannot be made from a path of `frames` frames, `rate` per second, because its size is odd
// or too large, the path does not have the chosen frames or segments, the title does not fit, or the output cannot be
// written or has another extension than a film's. Does not change any file.
void check_film(const FilmOptions& options, std::size_t frames, int rate);

// Makes the film: renders every unfinished segment, on all ranks, then the title, and joins them without re-encoding.
// The output file appears only when it is complete; an interrupted run can be continued by another call. Damaged
// segments are reported and rendered again. Prints progress to stderr. Throws InputError (check_film), Error (ffmpeg, a
// full disk, another run that makes a film of this name), Unavailable.
FilmStats make_film(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks);

struct StillOptions {
    std::string folder;
    bool jpeg = false;
    std::size_t every = 1;
    Picture picture;
    RendererOptions renderer;
    // Restrict the stills to frames of segments [first, second] and to the range `frames`. Segments are counted from
    // the first frame of `frames`.
    std::optional<Range> segments, frames;
};

// Throws InputError if stills cannot be made from a path of `frames` frames.
void check_stills(const StillOptions& options, std::size_t frames);

// Writes frame-000123.png (or .jpg) and its stamp for every N-th frame. Files that are finished according to their
// stamps are kept. Returns the number of stills, including those kept.
std::size_t make_stills(const Path& path, const Backend& backend, const StillOptions& options, Ranks& ranks);

}  // namespace mandelmarch
