// SPDX-License-Identifier: Apache-2.0
// Renders a path as a film or as still pictures.
#pragma once

#include <functional>
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

// Options of a film or of stills.
struct FilmOptions {
    std::string output = "video.mp4";
    std::string stills;  // folder for still frames instead of a film; empty: none
    // Only every `every`-th frame becomes a still. make_film() does not use it: the path of such a film has these
    // frames alone.
    std::size_t every = 1;
    std::string title;    // first line of the title before the flight; empty: none
    std::string authors;  // second line of the title; empty: none
    Picture picture;
    RendererOptions renderer;
    // For array jobs. If set, only segments [first, second] are rendered, and the film is not joined. Segments beyond
    // the film's end are ignored. Segment 0 begins at the first frame of `frames`.
    std::optional<Range> segments;
    // The frames [first, second] of the path that are shown; all if not set.
    std::optional<Range> frames;
    std::function<void(double)> progress;  // receives the finished share of the film, beside stderr; may be empty
};

// Statistics of make_film().
struct FilmStats {
    std::size_t segments = 0;  // segments of the whole film
    std::size_t rendered = 0;  // segments rendered in this run, by all ranks
    std::size_t frames = 0;    // frames in the segments rendered in this run
    double seconds = 0;
    bool joined = false;  // true: the film is complete
};

// Returns `frames`, or [0, all - 1] if not set. `all`: number of frames of the path. Throws InputError if the path does
// not have all chosen frames.
Range chosen_frames(const std::optional<Range>& frames, std::size_t all);

// Returns the first of `segments`, or of all segments if not set, and the one after the last, without those beyond the
// end of a film of `frames` frames. Both are the same if none are left.
Range chosen_segments(const std::optional<Range>& segments, std::size_t frames);

// Throws InputError if the film cannot be made from a path of `frames` frames at `rate` frames per second:
// - The width or height is odd, too small or too large.
// - The container does not allow the frame rate.
// - The path does not have the chosen frames.
// - The title does not fit.
// - The output cannot be written, or its extension is not that of a film.
// - Segments are chosen, but the output is a pipe or device.
// Does not change any file.
void check_film(const FilmOptions& options, std::size_t frames, int rate);

// Makes the film: renders every unfinished segment, on all ranks, then the title, and joins them (without re-encoding,
// except for GIF). The output file appears only when it is complete. Another call continues an interrupted run. Damaged
// segments are reported and rendered again. Prints progress to stderr. Throws InputError as check_film() does, Error
// (ffmpeg failed, the disk is full, another run is making a film of this name) and Unavailable.
FilmStats make_film(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks);

// Throws InputError if stills cannot be made from a path of `frames` frames.
void check_stills(const FilmOptions& options, std::size_t frames);

// Writes frame-000123.png (or .jpg or .exr) and its stamp for every `every`-th of the chosen frames. Keeps files that
// are finished according to their stamps. Returns the number of stills, including those kept.
std::size_t make_stills(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks);

}  // namespace mandelmarch
