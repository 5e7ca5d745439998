// SPDX-License-Identifier: Apache-2.0
// made_program FILE.dat: a serial program that renders the Mandelbox, for tests of the backend `program`. The
// environment variable MADE_FAULT selects a fault: nearly, wrong, size, silent, elsewhere, text, fails, crashes, hangs,
// or forks (and hangs). If it is not set, the program has no fault.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "backends/all.h"
#include "core/image/formats/image_file.h"
#include "core/os/output_file.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"

namespace {

using namespace mandelmarch;

void draw(const std::string& file, const std::string& wrong)
{
    Scene scene = read_parameters(file, fractal_named("box")).scene;
    if (wrong == "nearly") scene.brightness *= 1.003;
    if (wrong == "wrong") scene.iterations -= 1;
    if (wrong == "size") scene.width += 1;
    if (wrong == "elsewhere") scene.image_file = "other.bmp";
    Image image(scene.width, scene.height, Image::Layers::bytes);
    make_reference_backend()->create({})->render(scene, image);
    write_image(scene.image_file, ImageFormat::bmp, image);
}

}  // namespace

int main(int, char** argv)
{
    const char* given = std::getenv("MADE_FAULT");
    const std::string wrong = given == nullptr ? "" : given;
    if (wrong == "silent") return 0;
    if (wrong == "text") {
        write_file("image.bmp", "no picture at all");
        return 0;
    }
    if (wrong == "fails") {
        std::fputs("made_program: I cannot\n", stderr);
        return 3;
    }
    if (wrong == "crashes") std::raise(SIGSEGV);
    if (wrong == "forks") static_cast<void>(fork());
    if (wrong == "hangs" || wrong == "forks") {
        for (;;) pause();
    }
    draw(argv[1], wrong);
    return 0;
}
