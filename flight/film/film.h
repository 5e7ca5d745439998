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

struct FilmOptions {
    std::string output = "video.mp4";
    std::string title;    // first line before the flight; empty: none
    std::string authors;  // second line
    Picture picture;
    RendererOptions renderer;
    // Segments [first, second] alone, for array jobs: they are rendered, and the film is not joined.
    std::optional<std::pair<std::size_t, std::size_t>> segments;
};

// What was done, for the log.
struct FilmReport {
    std::size_t segments = 0;  // in the film
    std::size_t rendered = 0;  // segments, in this run, by all ranks
    std::size_t frames = 0;    // frames in these
    double seconds = 0;
    bool joined = false;  // the film stands
};

// Makes the film: every segment that is not finished yet, by all ranks, then the title, and joins them without encoding
// again. The film appears whole or not at all; a run that ends before goes on where it stopped. Progress goes to
// stderr. Throws InputError (a size that is odd, segments that are not there), Error (ffmpeg, a full disk),
// Unavailable.
FilmReport make_film(const Path& path, const Backend& backend, const FilmOptions& options, Ranks& ranks);

struct StillOptions {
    std::string folder;
    bool jpeg = false;
    std::size_t first = 0, last = 0;  // frames [first, last)
    std::size_t every = 1;
    Picture picture;
    RendererOptions renderer;
};

// Writes frame-000123.png (or .jpg) for every so manieth frame; those that are there already stay. Returns how many
// were written.
std::size_t make_stills(const Path& path, const Backend& backend, const StillOptions& options, Ranks& ranks);

}  // namespace mandelmarch
