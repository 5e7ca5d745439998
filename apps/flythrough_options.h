// SPDX-License-Identifier: Apache-2.0
// The command line of flythrough.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/files.h"
#include "core/render/registry.h"
#include "core/scene/fractal.h"
#include "flight/film/film.h"

namespace mandelmarch {

// The look that a film has unless --look chooses another.
inline constexpr int film_look = 3;

enum class Command { plan, render, film, audit };

struct Flythrough {
    Command command = Command::film;
    std::string path;        // a path file: read by render and audit, written by film
    std::string parameters;  // a parameter file whose fractal is flown through
    std::string fractal{fractals().front().name};
    std::uint64_t seed = 1;
    int frames = 7200;             // of the flight that is planned
    int rate = frames_per_second;  // frames a second of the flight that is planned
    std::optional<Range> chosen;   // render: only these frames of the path
    int width = 1920, height = 1080;
    double samples = 1;
    Projection projection = Projection::perspective;
    bool stereo = false;
    bool conservative = true;  // the estimate of what is planned; a path file says its own
    std::string backend = "auto";
    RendererOptions renderer;
    bool device_given = false;
    int threads = 0;
    std::optional<int> look;
    std::string power, scale;  // how that number of the shape changes in flight (flight/plan/schedule.h)
    std::string output, json, map, summary, stills, title, authors;
    bool jpeg = false;
    std::size_t every = 1;
    std::optional<Range> segments;
    bool force = false;

    Picture picture() const { return {width, height, samples, look, projection, stereo}; }
    // The files that the command writes and reads, with their options; a name is empty where none is given.
    std::vector<NamedFile> written() const;
    std::vector<NamedFile> read() const;
};

// `done`: the exit code where there is nothing to do but that (help). Throws InputError.
Flythrough parse_flythrough(const Registry& registry, int argc, char** argv, std::optional<int>& done);

// The number of threads for one of `local` processes on this machine: that of core/base/cores.h, divided
// among the processes if this one may run on all cores and OMP_NUM_THREADS is not set.
int threads_for(int local);

// Throws Error, in one line, before anything is drawn, where films cannot be made on this machine.
void check_film_tools(const std::string& film);

}  // namespace mandelmarch
