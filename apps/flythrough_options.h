// SPDX-License-Identifier: Apache-2.0
// The command line of flythrough.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/os/files.h"
#include "core/render/registry.h"
#include "core/scene/fractal.h"
#include "flight/audit/chapters.h"
#include "flight/film/film.h"

namespace mandelmarch {

enum class Command { plan, render, preview, film, audit };

struct Flythrough {
    Command command = Command::film;
    std::string path;        // a path file: read by render, preview and audit, written by film
    std::string parameters;  // a parameter file with the fractal
    std::string places;      // plan, film: a places file
    std::string fractal{fractals().front().name};
    std::uint64_t seed = 1;
    int frames = 7200;             // plan, film: length of the flight
    int rate = frames_per_second;  // plan, film: frames per second
    std::optional<Range> chosen;   // render, preview: only these frames of the path
    Part part;                     // film, render, preview: only this part of the path
    int width = 1920, height = 1080;
    double samples = 1;
    Projection projection = Projection::perspective;
    bool stereo = false;
    bool conservative = true;  // plan, film: the kind of estimate; a path file contains its own
    std::string backend = "auto";
    RendererOptions renderer{.precision = Precision::f32, .mode = Mode::fast};
    std::optional<int> device;  // nullopt: each MPI rank uses its own GPU
    int threads = 0;
    std::string look_file;  // --look, if it names a file
    std::optional<ChosenLook> look;
    std::string power, scale;  // schedules of these shape parameters as text, see parse_schedule(); empty: not given
    std::string output, json, map, summary, stills, title, authors;
    bool jpeg = false;
    std::size_t every = 1;
    std::optional<Range> segments;
    bool force = false;

    // Returns true if the command reads the path from a file; false: it plans the path.
    bool reads_path() const { return command != Command::plan && command != Command::film; }
    // Returns true if the command makes a film, not only stills.
    bool makes_film() const { return command != Command::plan && command != Command::audit && stills.empty(); }
    Picture picture() const { return {width, height, samples, look, projection, stereo}; }
    // Returns the files that the command writes, each with its option. read() returns the files that the command reads.
    // The path of a file is empty if its option is not given.
    std::vector<NamedFile> written() const;
    std::vector<NamedFile> read() const;
};

// Parses the command line. After --help or --version, sets `done` to the exit code with which the program should end.
// Throws InputError if an argument is invalid.
Flythrough parse_flythrough(const Registry& registry, int argc, char** argv, std::optional<int>& done);

}  // namespace mandelmarch
