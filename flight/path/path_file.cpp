// SPDX-License-Identifier: Apache-2.0
// Path files: JSON with one line per frame, for editing by hand.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "core/os/input_file.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "core/text/json.h"
#include "core/text/text.h"
#include "flight/path/path.h"

namespace mandelmarch {
namespace {

using Json = nlohmann::json;

constexpr const char* format_name = "mandelmarch path 1";
constexpr std::size_t most_frames = 10'000'000;             // 92 hours at 30 frames per second
constexpr std::size_t largest_file = std::size_t{4} << 30;  // bytes; more than so many frames need
constexpr const char* by_size = "by size";
constexpr double usual_detail = -3;  // value of scene.detail if the detail level follows from the picture size
constexpr ParameterInfo detail_meaning{"detail level", -37, 3};
constexpr ParameterInfo brightness_meaning{"brightness", 0, 1e6};
constexpr std::size_t longest_cause = 300;  // bytes of a parser's message
constexpr std::size_t longest_value = 80;   // bytes of a value in a message

std::string number(double value) { return fmt::format("{:.10g}", value == 0 ? 0.0 : value); }

std::string triple(Vector v) { return fmt::format("[{}, {}, {}]", number(v.x), number(v.y), number(v.z)); }

double cut(double value) { return std::strtod(number(value).c_str(), nullptr); }

Vector cut(Vector v) { return {cut(v.x), cut(v.y), cut(v.z)}; }

std::string changes_text(const Changes& changes)
{
    std::string text;
    if (changes.detail) text += fmt::format(", \"detail\": {}", number(*changes.detail));
    if (changes.shape) {
        const auto& [a, b, c] = *changes.shape;
        text += fmt::format(", \"shape\": {}", triple({a, b, c}));
    }
    if (changes.iterations) text += fmt::format(", \"iterations\": {}", *changes.iterations);
    if (changes.escape) text += fmt::format(", \"escape\": {}", number(*changes.escape));
    if (changes.colouring) text += fmt::format(", \"colouring\": {}", *changes.colouring);
    if (changes.brightness) text += fmt::format(", \"brightness\": {}", number(*changes.brightness));
    return text;
}

// Formats a value for a message.
std::string shown(const Json& value) { return printable(value.dump(), longest_value); }

constexpr std::array<std::string_view, 6> whole_keys{"format", "fractal", "seed", "frames_per_second",
                                                     "scene",  "frames"};
constexpr std::array<std::string_view, 7> scene_keys{"detail",    "shape",      "iterations", "escape",
                                                     "colouring", "brightness", "estimate"};
constexpr std::array<std::string_view, 10> frame_keys{
    "location", "look_at", "up", "field_of_view", "detail", "shape", "iterations", "escape", "colouring", "brightness"};

// Reads and checks the values of one JSON object. Error messages begin with `place`, which names the file and the
// object.
class PathReader {
public:
    PathReader(const Json& object, std::string place, const Fractal& fractal)
        : object_(object), place_(std::move(place)), fractal_(fractal)
    {
        if (!object.is_object()) fail("not an object, expected {...}");
    }

    [[noreturn]] void fail(const std::string& why) const { throw InputError(fmt::format("{}: {}", place_, why)); }

    bool has(const char* key) const { return object_.contains(key); }

    // Throws InputError if the object has a key that is not one of `keys`, because it may be a spelling mistake.
    void know(std::span<const std::string_view> keys) const
    {
        for (const auto& [key, value] : object_.items()) {
            if (std::ranges::find(keys, key) != keys.end()) continue;
            fail(fmt::format("unknown key \"{}\", expected some of {}", printable(key, longest_value),
                             fmt::join(keys, ", ")));
        }
    }

    const Json& value(const char* key) const
    {
        const auto found = object_.find(key);
        if (found == object_.end()) fail(fmt::format("\"{}\" is missing", key));
        return *found;
    }

    double real(const char* key, const ParameterInfo& meaning) const { return checked(value(key), key, meaning); }

    double single(const char* key, const ParameterInfo& meaning) const
    {
        return checked_single(value(key), key, meaning);
    }

    int whole(const char* key, int low, int high) const
    {
        const Json& found = value(key);
        if (!found.is_number_integer() || found.get<double>() < low || found.get<double>() > high) {
            fail(fmt::format("\"{}\" is {}, expected a whole number from {} to {}", key, shown(found), low, high));
        }
        return found.get<int>();
    }

    Vector vector(const char* key) const
    {
        const auto [x, y, z] = three(key, {ParameterInfo{key, -1e9, 1e9}, {key, -1e9, 1e9}, {key, -1e9, 1e9}});
        return {x, y, z};
    }

    std::array<double, 3> three(const char* key, const std::array<ParameterInfo, 3>& meanings) const
    {
        const Json& found = value(key);
        if (!found.is_array() || found.size() != 3) {
            fail(fmt::format("\"{}\" is {}, expected three numbers [x, y, z]", key, shown(found)));
        }
        std::array<double, 3> numbers{};
        for (std::size_t i = 0; i < 3; ++i) numbers[i] = checked(found[i], key, meanings[i]);
        return numbers;
    }

    std::array<double, 3> shape() const
    {
        auto shape = three("shape", fractal_.shape);
        for (std::size_t i = 0; i < 3; ++i) shape[i] = checked_single(value("shape")[i], "shape", fractal_.shape[i]);
        return shape;
    }

    std::uint64_t seed() const
    {
        const Json& found = value("seed");
        if (!found.is_number_unsigned()) fail(fmt::format("\"seed\" is {}, expected a whole number", shown(found)));
        return found.get<std::uint64_t>();
    }

    bool is_conservative(const char* key) const
    {
        const Json& found = value(key);
        if (found != original_estimate && found != conservative_estimate) {
            fail(fmt::format("\"{}\" is {}, expected \"{}\" or \"{}\"", key, shown(found), original_estimate,
                             conservative_estimate));
        }
        return found == conservative_estimate;
    }

    Changes changes() const
    {
        Changes result;
        if (has("detail")) result.detail = single("detail", detail_meaning);
        if (has("shape")) result.shape = shape();
        if (has("iterations")) result.iterations = whole("iterations", 1, max_iterations);
        if (has("escape")) result.escape = single("escape", fractal_.escape);
        if (has("colouring")) result.colouring = whole("colouring", 0, colouring_types - 1);
        if (has("brightness")) result.brightness = single("brightness", brightness_meaning);
        return result;
    }

private:
    double checked(const Json& found, const char* key, const ParameterInfo& meaning) const
    {
        const double number = found.is_number() ? found.get<double>() : NAN;
        return within(number, found, key, meaning);
    }

    // Returns a number rounded to single precision, as the reader of parameter files rounds it.
    double checked_single(const Json& found, const char* key, const ParameterInfo& meaning) const
    {
        return within(static_cast<float>(checked(found, key, meaning)), found, key, meaning);
    }

    double within(double number, const Json& found, const char* key, const ParameterInfo& meaning) const
    {
        const bool fine = number <= meaning.high && (meaning.open_low ? number > meaning.low : number >= meaning.low);
        if (!fine) {
            fail(fmt::format("\"{}\" has {}, expected {}, {} {:.6g} and at most {:.6g}", key, shown(found),
                             meaning.name, meaning.open_low ? "more than" : "at least", meaning.low, meaning.high));
        }
        return number;
    }

    const Json& object_;
    std::string place_;
    const Fractal& fractal_;
};

void read_scene(const Json& object, const std::string& place, Path& path)
{
    const PathReader reader(object, place, *path.scene.fractal);
    reader.know(scene_keys);
    path.detail_by_size = reader.value("detail") == by_size;
    path.scene.detail = path.detail_by_size ? usual_detail : reader.single("detail", detail_meaning);
    path.scene.shape = reader.shape();
    path.scene.iterations = reader.whole("iterations", 1, max_iterations);
    path.scene.escape = reader.single("escape", path.scene.fractal->escape);
    path.scene.colouring = reader.whole("colouring", 0, colouring_types - 1);
    path.scene.brightness = reader.single("brightness", brightness_meaning);
    path.scene.conservative = reader.has("estimate") && reader.is_conservative("estimate");
}

Frame read_frame(const Json& object, const std::string& place, const Path& path)
{
    const PathReader reader(object, place, *path.scene.fractal);
    reader.know(frame_keys);
    Frame frame;
    frame.eye = reader.vector("location");
    frame.target = reader.vector("look_at");
    frame.up = reader.vector("up");
    frame.field_of_view = reader.real("field_of_view", {"the field of view", 0, max_field_of_view * 0.999, true});
    frame.changes = reader.changes();
    check_scene(scene_of(path, frame, 16, 9), [&](Item) { return place; });
    return frame;
}

}  // namespace

void cut_digits(Path& path)
{
    for (Frame& frame : path.frames) {
        frame.eye = cut(frame.eye);
        frame.target = cut(frame.target);
        frame.up = cut(frame.up);
        frame.field_of_view = cut(frame.field_of_view);
    }
}

std::string to_text(const Path& path)
{
    const Scene& scene = path.scene;
    const auto& [a, b, c] = scene.shape;
    std::string text = fmt::format(
        "{{\n\"format\": \"{}\",\n\"fractal\": \"{}\",\n\"seed\": {},\n\"frames_per_second\": {},\n\"scene\": "
        "{{\"detail\": {}, "
        "\"shape\": {}, \"iterations\": {}, \"escape\": {}, \"colouring\": {}, \"brightness\": {}, \"estimate\": "
        "\"{}\"}},\n\"frames\": [\n",
        format_name, scene.fractal->name, path.seed, path.frames_per_second,
        path.detail_by_size ? fmt::format("\"{}\"", by_size) : number(scene.detail), triple({a, b, c}),
        scene.iterations, number(scene.escape), scene.colouring, number(scene.brightness),
        scene.conservative ? conservative_estimate : original_estimate);
    for (std::size_t i = 0; i < path.frames.size(); ++i) {
        const Frame& frame = path.frames[i];
        text += fmt::format("{{\"location\": {}, \"look_at\": {}, \"up\": {}, \"field_of_view\": {}{}}}{}\n",
                            triple(frame.eye), triple(frame.target), triple(frame.up), number(frame.field_of_view),
                            changes_text(frame.changes), i + 1 < path.frames.size() ? "," : "");
    }
    return text + "]\n}\n";
}

Path path_from_text(const std::string& text, const std::string& name)
{
    Json json;
    try {
        json = parse_json(text, name);
    } catch (const Json::exception& error) {
        throw InputError(
            fmt::format("{}: {}, expected a path file (JSON)", name, printable(error.what(), longest_cause)));
    }
    if (!json.is_object() || json.value("format", Json()) != format_name) {
        throw InputError(fmt::format("{}: its \"format\" is not \"{}\", expected a path file", name, format_name));
    }
    Path path;
    if (!json.contains("fractal") || !json["fractal"].is_string()) throw InputError(name + ": \"fractal\" is missing");
    try {
        path.scene.fractal = &fractal_named(json["fractal"].get<std::string>());
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", name, printable(error.what(), longest_cause)));
    }
    const PathReader whole(json, name, *path.scene.fractal);
    whole.know(whole_keys);
    if (whole.has("seed")) path.seed = whole.seed();
    if (whole.has("frames_per_second"))
        path.frames_per_second = whole.whole("frames_per_second", 1, most_frames_per_second);
    read_scene(whole.value("scene"), name + ": scene", path);
    const Json& frames = whole.value("frames");
    if (!frames.is_array() || frames.empty())
        whole.fail("\"frames\" is empty or not a list, expected a list of cameras");
    if (frames.size() > most_frames) whole.fail("it has too many frames");
    path.frames.reserve(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        path.frames.push_back(read_frame(frames[i], fmt::format("{}: frame {}", name, i), path));
    }
    cut_digits(path);
    return path;
}

Path read_path(const std::string& file) { return path_from_text(text_of_file(file, "path file", largest_file), file); }

}  // namespace mandelmarch
