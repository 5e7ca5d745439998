// SPDX-License-Identifier: Apache-2.0
// Fuzzer of all formats: any bytes, read as a file of the format that the first argument names, give valid values, or
// an InputError, of one line but for pictures. The other arguments are libFuzzer's.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "bench/measure/runs.h"
#include "bench/print/printers.h"
#include "bench/result/compare.h"
#include "bench/result/portability.h"
#include "bench/result/result_file.h"
#include "core/image/formats/image_file.h"
#include "core/render/kernel_scene.h"
#include "core/scene/fractal.h"
#include "core/scene/look.h"
#include "core/scene/parameter_file.h"
#include "core/text/error.h"
#include "flight/path/path.h"
#include "flight/path/places.h"
#include "flight/route/schedule.h"

namespace {

using namespace mandelmarch;
using namespace mandelmarch::bench;

void demand(bool held)
{
    if (!held) std::abort();
}

// Calls read(). If it throws an InputError, the message must be one line that begins with `begin`.
template <class Read>
void checked(std::string_view begin, const Read& read)
{
    try {
        read();
    } catch (const InputError& error) {
        const std::string_view message = error.what();
        demand(message.starts_with(begin) || message.starts_with("bench compare: "));
        demand(message.find('\n') == std::string_view::npos && message.size() < 1000);
    }
}

using Decoder = Image (*)(std::span<const std::byte> data, const std::string& name);

// Messages for pictures may contain OpenEXR's, which quote any bytes.
template <Decoder decode>
void picture(std::string_view text)
{
    try {
        const Image image = decode(std::as_bytes(std::span(text)), "x");
        demand(image.pixels() > 0 && image.bytes().size() == 3 * image.pixels());
        demand(!image.has_values() || image.values().size() == image.pixels());
    } catch (const InputError&) {
    }
}

void look(std::string_view text)
{
    checked("x:", [&] {
        const LookValues look = parse_look(text, "x");
        std::size_t at = 0;
        for (const LookEntry& entry : look_entries) {
            for (const LookRange& range : entry.ranges) {
                const double number = look.numbers.at(at++);
                const bool missing = number == 0 && entry.name != "exposure";
                demand(missing || (number >= range.low && number <= range.high));
            }
        }
    });
}

void parameter_file(std::string_view text)
{
    for (const Fractal& fractal : fractals()) {
        checked("x:", [&] {
            const Scene scene = parse_parameters(text, "x", fractal).scene;
            demand(scene.width > 0 && scene.height > 0 && scene.iterations > 0 && !scene.image_file.empty());
            const auto kernel = kernel_scene<layout_f32::Scene>(scene, Mode::exact);
            demand(std::isfinite(kernel.across.x) && kernel.tolerance > 0);
        });
    }
}

void path_file(std::string_view text)
{
    checked("x: ", [&] {
        const Path path = path_from_text(std::string(text), "x");
        demand(!path.frames.empty() && path.scene.iterations > 0);
        const std::string written = to_text(path);
        demand(to_text(path_from_text(written, "y")) == written);
    });
}

void places(std::string_view text)
{
    checked("x:", [&] {
        for (const Place& place : places_from_text(std::string(text), "x").all) {
            demand(place.stay >= 0 && place.stay <= most_stay && std::isfinite(place.second.value_or(0)));
            const std::string line = place_line(place);
            const Places again = places_from_text(std::string(places_header) + "\n" + line + "\n", "y");
            demand(again.all.size() == 1 && place_line(again.all[0]) == line);
        }
    });
}

// The schedule of the power if the text begins with p, otherwise that of the scale.
void schedule(std::string_view text)
{
    constexpr int frames = 3600;
    checked("--", [&] {
        const bool power = text.starts_with('p');
        const Fractal& fractal = fractal_named(power ? "bulb" : "box");
        const Schedule schedule = parse_schedule(power ? "power" : "scale", std::string(text.substr(power ? 1 : 0)),
                                                 official_scene(fractal, 16, 9), frames);
        const ParameterInfo& range = fractal.shape.at(schedule.number());
        double last = -1;
        for (const Knot& knot : schedule.knots()) {
            const double value = schedule.value(knot.frame);
            demand(knot.frame > last && knot.frame < frames && value >= range.low && value <= range.high);
            last = knot.frame;
        }
    });
}

bool share(double value) { return value >= 0 && value <= 1; }

// A result compared with itself is not a regression. Its efficiencies are from 0 to 1.
void result_json(std::string_view of)
{
    checked("x: ", [&] {
        const Result result = parse_result(std::string(of), "x");
        const std::string text = text_of(json_of(result));
        demand(text_of(json_of(parse_result(text, "x"))) == text);
        demand(to_csv(result).find('\n') != std::string::npos);
        if (result.runs > 1000) return;
        const Result twice = with_further_runs(result, result.runs + 1, [&](int) { return result; });
        for (std::size_t i = 0; i < result.rows.size(); ++i) {
            demand(twice.rows[i].samples.size() == 2 * result.rows[i].samples.size());
        }
        const std::vector<Portability> found = portability(std::vector{result, twice});
        for (const Portability& p : found) {
            demand(share(p.application_portability) && share(p.application_interval.low));
            for (const OnPlatform& on : p.platforms) demand(share(on.application) && std::isfinite(on.seconds));
        }
        demand(!to_csv(found).empty() && !to_console(found).empty() && !text_of(json_of(found)).empty());
        const ComparedResults compared = compare_results(result, result);
        for (const Compared& row : compared.rows) demand(share(row.p));
        demand(!regression(compared.rows) && !to_console(compared).empty());
    });
}

struct Format {
    std::string_view name;
    void (*read)(std::string_view text);
};

constexpr Format formats[] = {
    {"bmp", picture<decode_bmp>},
    {"exr", picture<decode_exr>},
    {"look", look},
    {"parameter_file", parameter_file},
    {"path_file", path_file},
    {"places", places},
    {"png", picture<decode_png>},
    {"pnm", picture<decode_pnm>},
    {"result_json", result_json},
    {"schedule", schedule},
};

const Format* format = nullptr;

// Collects all values of a JSON document, including nested ones.
void collect(nlohmann::ordered_json& json, std::vector<nlohmann::ordered_json*>& values)
{
    values.push_back(&json);
    if (!json.is_structured()) return;
    for (auto& value : json) collect(value, values);
}

// Returns the unusual values with which the mutator replaces others.
const nlohmann::ordered_json& odd_values()
{
    static const auto values = nlohmann::ordered_json::parse(
        R"([null, true, 0, 1, -1, 2, 7, 0.5, 1e-320, 1e9, 1e300, 99999999, [], [1], {}, "", "float",
    "fast", "openmp", "reference", "all", 9007199254740993, 18446744073709551615])");
    return values;
}

}  // namespace

// Takes the format from the arguments.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
    const std::string_view name = *argc > 1 ? (*argv)[1] : "";
    format = std::ranges::find(formats, name, &Format::name);
    if (format == std::end(formats)) {
        std::fprintf(stderr, "fuzz: '%s' given, expected a format\n", name.data());
        std::exit(2);
    }
    std::copy(*argv + 2, *argv + *argc, *argv + 1);
    --*argc;
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size)
{
    format->read(std::string_view(reinterpret_cast<const char*>(data), size));
    return 0;
}

extern "C" std::size_t LLVMFuzzerMutate(unsigned char* data, std::size_t size, std::size_t most);

// Changes or copies one value of a complete JSON document, because changed bytes are rarely valid JSON. libFuzzer calls
// this function instead of changing bytes.
extern "C" std::size_t LLVMFuzzerCustomMutator(unsigned char* data, std::size_t size, std::size_t most, unsigned seed)
{
    std::minstd_rand random(seed);
    auto json = nlohmann::ordered_json::parse(data, data + size, nullptr, false);
    if (random() % 4 == 0 || !json.is_structured()) return LLVMFuzzerMutate(data, size, most);
    std::vector<nlohmann::ordered_json*> values;
    collect(json, values);
    const auto any = [&]() -> nlohmann::ordered_json& { return *values[random() % values.size()]; };
    if (random() % 4 != 0) {
        any() = odd_values()[random() % odd_values().size()];
    } else if (auto& list = any(); list.is_array() && !list.empty()) {
        const auto first = list.front();
        list.push_back(first);
    } else {
        const auto other = any();
        list = other;
    }
    const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
    std::copy(text.begin(), text.end(), data);
    return text.size();
}
