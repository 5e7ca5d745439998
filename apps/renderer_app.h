// SPDX-License-Identifier: Apache-2.0
// The program behind mandelbulb, mandelbox and render.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "backends/all.h"
#include "core/os/program.h"

namespace mandelmarch {

// Memory that the program needs in addition to the picture: code, libraries, the threads' stacks, one row of a file.
inline constexpr std::uint64_t fixed_memory = 128ULL << 20;  // bytes
// An EXR file that is written to a pipe is built in memory, in two copies of nine channels of four bytes.
inline constexpr std::uint64_t exr_stream_memory = 72;  // bytes per pixel

struct RenderOptions {
    std::string parameters;
    std::string fractal;
    std::string backend = "auto";
    RendererOptions renderer;
    std::string size;
    std::string region;
    std::string output;
    std::string stats;
    std::string pixel;
    std::string without;
    std::optional<ChosenLook> look;
    std::string look_file;  // --look, if it names a file
    bool conservative = false;
    Projection projection = Projection::perspective;
    double eyes = 0;
    int samples = 0;  // per pixel side; 0: not given, the parameter file decides
    bool trace = false;
    bool list_devices = false;
    bool list_fractals = false;
    bool json = false;
    bool print_scene = false;

    // Returns true if the program only lists devices or fractals.
    bool lists() const { return list_devices || list_fractals; }
};

// Parses the arguments. `fractal`: the fractal's name; nullptr if the option --fractal gives it. Sets `done` to an exit
// code if the program has nothing more to do. Throws InputError.
RenderOptions parse_options(const char* program, const char* fractal, const Registry& registry, int argc, char** argv,
                            std::optional<int>& done);

// Runs the program with these backends. `fractal`: the fractal's name; nullptr if the option --fractal gives it.
int render_program(const Registry& registry, const char* program, const char* fractal, int argc, char** argv);

// The main function of these programs. It is inline, so that each program links the backends that it lists.
inline int renderer_main(const char* program, const char* fractal, int argc, char** argv)
{
    const auto body = [&](int count, char** values) {
        return render_program(program_backends(count, values), program, fractal, count, values);
    };
    return run_program(program, body, argc, argv);
}

}  // namespace mandelmarch
