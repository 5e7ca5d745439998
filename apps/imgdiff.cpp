// SPDX-License-Identifier: Apache-2.0
// imgdiff A B: compares two pictures. The exit code is 0 if they are the same, 1 if they differ.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "apps/cli/options.h"
#include "core/image/compare.h"
#include "core/image/formats/image_file.h"
#include "core/os/files.h"
#include "core/os/output_file.h"
#include "core/os/program.h"
#include "core/text/console.h"
#include "core/text/error.h"
#include "core/text/text.h"
#include "core/text/version.h"

namespace {

using namespace mandelmarch;

// Returns the command that traces the first differing pixel. FRACTAL and PARAMS in the command are placeholders,
// because a picture does not record its fractal and parameter file.
std::string trace_command(const Image& image, const Comparison& c)
{
    return fmt::format("bin/render --fractal FRACTAL PARAMS.dat --size {}x{} --pixel {},{} --trace", image.width(),
                       image.height(), c.first % image.width(), c.first / image.width());
}

nlohmann::ordered_json json_of(const Image& image, const Comparison& c)
{
    nlohmann::ordered_json json{
        {"width", image.width()},
        {"height", image.height()},
        {"same", c.same()},
        {"differing_pixels", c.differing},
        {"visibly_differing_pixels", c.visibly_differing},
        {"largest_difference", c.largest},
    };
    json["psnr_db"] = std::isinf(c.psnr) ? nlohmann::ordered_json() : nlohmann::ordered_json(c.psnr);
    json["compared"] = {"bytes"};
    if (c.values_compared) {
        json["compared"].push_back("colour");
        json["differing_colours"] = c.differing_colours;
    }
    if (c.depths_compared) {
        json["compared"].push_back("depth");
        json["differing_depths"] = c.differing_depths;
        json["hit_or_miss"] = c.hit_or_miss;
    }
    if (!c.same()) {
        json["first"] = {c.first % image.width(), c.first / image.width()};
        json["trace"] = trace_command(image, c);
    }
    return json;
}

void print_text(const Image& a, const Image& b, const Comparison& c)
{
    print("{} of {} pixels differ, {} by more than 2/255, at most {}/255, PSNR {:.2f} dB\n", c.differing, c.pixels,
          c.visibly_differing, c.largest, c.psnr);
    if (c.depths_compared) {
        print("{} differ in a bit of colour, {} in a bit of depth, {} hit in one picture only\n", c.differing_colours,
              c.differing_depths, c.hit_or_miss);
    } else if (c.values_compared) {
        print("{} differ in a bit of colour; depths are not compared, as not both pictures have them\n",
              c.differing_colours);
    }
    if (!c.same()) {
        print("first: {}\n", describe_pixel(a, b, c.first));
        print("why: {}, with the pictures' --precision and --mode\n", trace_command(a, c));
    }
}

int body(int argc, char** argv)
{
    CLI::App app("imgdiff: compares two pictures (BMP, PNG, PNM, EXR) pixel by pixel.");
    app.set_version_flag("--version", version_line("imgdiff"));
    std::string first;
    std::string second;
    std::string map;
    bool json = false;
    app.add_option("A", first, "first picture; -: standard input")->required();
    app.add_option("B", second, "second picture; -: standard input")->required();
    app.add_option("--map", map, "write a map of differences (white: equal) to this .png, .bmp, .ppm or .jpg");
    app.add_flag("--json", json, "print the result as JSON");
    app.footer(
        "Two EXR pictures are compared bit for bit: their colours and, if both have depths, their depths. Other "
        "pictures are compared by the 8-bit colours of their pixels.\n"
        "Pixels are counted from the bottom left. Exit codes: 0 same, 1 different, 2 bad input.");
    if (const auto done = parse_arguments(app, "imgdiff", argc, argv)) return *done;
    first = input_name(first);
    second = input_name(second);
    map = output_name(map);
    const auto format = OutputFile::is_stream(map) ? ImageFormat::bmp : image_format(map);
    if (!map.empty()) {
        if (!format || *format == ImageFormat::exr) {
            throw InputError(map +
                             ": the file name's ending names no format for a map, expected .png, .bmp, .ppm or .jpg");
        }
        refuse_shared_files({{"--map", map}}, {{"A", first}, {"B", second}});
        OutputFile::check(map);
    }
    const Image a = read_image(first);
    const Image b = read_image(second);
    if (a.width() != b.width() || a.height() != b.height()) {
        say("imgdiff: {} has {} x {} pixels, {} has {} x {}\n", printable(first), a.width(), a.height(),
            printable(second), b.width(), b.height());
        return exit_failure;
    }
    const Comparison comparison = compare(a, b);
    if (!map.empty()) write_image(map, *format, difference_map(a, b));
    if (json) {
        print("{}\n", json_of(a, comparison).dump(2));
    } else {
        print_text(a, b, comparison);
    }
    return comparison.same() ? exit_success : exit_failure;
}

}  // namespace

int imgdiff_main(int argc, char** argv) { return mandelmarch::run_program("imgdiff", body, argc, argv); }
