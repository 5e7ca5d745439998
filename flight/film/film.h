// SPDX-License-Identifier: Apache-2.0
// A path into a film.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/render/backend.h"
#include "flight/film/frames.h"
#include "flight/film/ranks.h"
#include "flight/path/path.h"

namespace mandelmarch {

// From the first to the second, both included.
using Range = std::pair<std::size_t, std::size_t>;

struct FilmOptions {
    std::string output = "video.mp4";
    std::string title;    // first line before the flight; empty: none
    std::string authors;  // second line
    Picture picture;
    RendererOptions renderer;
    // Segments [first, second] alone, for array jobs: those of them that the film has are rendered, and the film is not
    // joined.
    std::optional<Range> segments;
    // A film of the path's frames [first, second] alone.
    std::optional<Range> frames;
};

// What was done, for the log.
struct FilmReport {
    std::size_t segments = 0;  // in the film
    std::size_t rendered = 0;  // segments, in this run, by all ranks
    std::size_t frames = 0;    // frames in these
    double seconds = 0;
    bool joined = false;  // the film stands
};

// The frames that are asked for of a path with so many. Throws InputError where it does not have all of them.
Range chosen_frames(const std::optional<Range>& frames, std::size_t all);

// The segments that are asked for of a film of so many frames; the last task of an array job may ask for more than
// there are. Throws InputError where the film has none of them.
Range chosen_segments(const std::optional<Range>& segments, std::size_t frames);

// Throws InputError where such a film of so many frames, at so many a second, certainly cannot be made: a size that is
// odd or too large, frames or segments that the path does not have, a title that does not fit, an output that cannot be
// written or whose ending names no kind of film. Touches nothing.
void check_film(const FilmOptions& options, std::size_t frames, int rate);

// Makes the film: every segment that is not finished yet, by all ranks, then the title, and joins them without encoding
// again. The film appears whole or not at all; a run that ends before goes on where it stopped. A piece that is no
// longer as it was made is named and made again. Progress goes to stderr. Throws InputError (check_film), Error
// (ffmpeg, a full disk, another run that makes a film of this name), Unavailable.
FilmReport make_film(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks);

struct StillOptions {
    std::string folder;
    bool jpeg = false;
    std::size_t every = 1;
    Picture picture;
    RendererOptions renderer;
    // Only frames of these segments [first, second], or of these frames; segments are counted from the first of these.
    std::optional<Range> segments, frames;
};

// As check_film(), for stills.
void check_stills(const StillOptions& options, std::size_t frames);

// Writes frame-000123.png (or .jpg) for every N-th frame, each with a note of what it was made of; those that are
// there already, as their notes say, stay. Returns how many these are.
std::size_t make_stills(const Path& path, const Backend& backend, const StillOptions& options, Ranks& ranks);

}  // namespace mandelmarch
