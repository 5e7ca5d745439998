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

// The numbers from the first to the second, both included.
using Range = std::pair<std::size_t, std::size_t>;

struct FilmOptions {
    std::string output = "video.mp4";
    std::string title;    // first line before the flight; empty: none
    std::string authors;  // second line
    Picture picture;
    RendererOptions renderer;
    // Only segments [first, second], for array jobs: those that the film has are rendered, and the film is not joined.
    // The last task of an array may ask for more than there are.
    std::optional<Range> segments;
    // Only the path's frames [first, second] become the film.
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

// The chosen frames of a path with `all` frames. Throws InputError if the path does not have all of them.
Range chosen_frames(const std::optional<Range>& frames, std::size_t all);

// The chosen segments of a film with `frames` frames, without those beyond its end, for which the last task of an array
// job may ask. Throws InputError if the film has none of the chosen segments.
Range chosen_segments(const std::optional<Range>& segments, std::size_t frames);

// Throws InputError if a film of `frames` frames, `rate` a second, certainly cannot be made: its size is odd or too
// large, the path does not have the chosen frames or segments, the title does not fit, or the output cannot be written
// or its ending names no kind of film. Changes no file.
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
    // Only frames of these segments [first, second] or of the range `frames`, from whose first frame segments count.
    std::optional<Range> segments, frames;
};

// As check_film(), for stills.
void check_stills(const StillOptions& options, std::size_t frames);

// Writes frame-000123.png (or .jpg) for every N-th frame, each with a note of what it was made of; those that are
// there already, as their notes say, stay. Returns how many these are.
std::size_t make_stills(const Path& path, const Backend& backend, const StillOptions& options, Ranks& ranks);

}  // namespace mandelmarch
