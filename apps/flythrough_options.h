// SPDX-License-Identifier: Apache-2.0
// The command line of flythrough, and the plan that it describes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/os/files.h"
#include "core/render/registry.h"
#include "core/scene/fractal.h"
#include "flight/audit/motion.h"
#include "flight/film/film.h"
#include "flight/ride/planner.h"

namespace mandelmarch {

enum class Command { plan, render, preview, film, audit };

struct Flythrough {
    Command command = Command::film;
    std::string path;        // a path file: read by render, preview and audit, written by film
    std::string parameters;  // a parameter file with the fractal
    std::string places;      // plan, film: a places file
    std::string fractal{fractals().front().name};
    PlanOptions plan;          // completed by read_plan()
    int frames = 0;            // plan, film: length of the flight
    int rate = 0;              // frames per second; 0: those of the path file
    Part part;                 // film, render, preview: only this part of the path
    std::string size;          // --size; empty: the command's default
    bool conservative = true;  // plan, film: the kind of estimate; a path file contains its own
    std::string backend = "auto";
    std::optional<int> device;  // nullopt: each MPI rank uses its own GPU
    std::string look_file;      // --look, if it names a file
    std::string power, scale;   // schedules of these shape parameters as text, see parse_schedule(); empty: not given
    std::string json, map, summary;
    bool force = false;
    // The pictures, also for an audit. plan writes the path file to `output`.
    FilmOptions film;

    // Returns true if the command reads the path from a file; false: it plans the path.
    bool reads_path() const { return command != Command::plan && command != Command::film; }
    // Returns true if the command makes a film, not only stills.
    bool makes_film() const { return command != Command::plan && command != Command::audit && film.stills.empty(); }
    // Returns the files that the command writes, each with its option. read() returns the files that the command reads.
    // The path of a file is empty if its option is not given.
    std::vector<NamedFile> written() const;
    std::vector<NamedFile> read() const;
};

// Parses the command line. After --help or --version, sets `done` to the exit code with which the program should end.
// Throws InputError if an argument is invalid.
Flythrough parse_flythrough(const Registry& registry, int argc, char** argv, std::optional<int>& done);

// Reads the files that describe the plan. Prints warnings about the parameter file. Throws InputError if the fractal
// cannot be flown through, or if a file is invalid.
PlanOptions read_plan(const Flythrough& options);

// Plans the flight, with the number of frames and the frame rate of the options. Prints progress to stderr.
Plan make_plan(const Flythrough& options);

// Returns the map of a plan, from which a drawing can be made, as JSON: the bounds of the first frame's shape, and the
// balls and gates near the path. A passage is given by the number of its narrowest frame. Each frame has its position,
// its clearance (the distance estimate), and its turn since the previous frame in degrees. `threads`: 0 for as many as
// the process may use.
std::string map_of(const Plan& made, int threads);

}  // namespace mandelmarch
