// SPDX-License-Identifier: Apache-2.0
#include "core/scene/parameter_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <optional>

#include "core/image/image.h"
#include "core/os/input_file.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "core/text/number.h"
#include "core/text/text.h"

namespace mandelmarch {
namespace {

constexpr std::size_t longest_quote = 40;  // bytes of the user's text in a message

std::string quoted(std::string_view text) { return fmt::format("'{}'", printable(text, longest_quote)); }

// Removes a comment. It begins with a # that is the first character of the line or follows a blank.
std::string_view without_comment(std::string_view line)
{
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '#' && (i == 0 || blanks.find(line[i - 1]) != std::string_view::npos)) return line.substr(0, i);
    }
    return line;
}

// Counts the values of lines 7 and 8 that are unusual for a fractal: those outside the range of their slider, and those
// that are not 0 although the fractal ignores them. Returns nullopt if the fractal does not accept the values.
std::optional<int> oddities(const Scene& scene, const Fractal& fractal)
{
    int count = 0;
    const auto look = [&](double value, const ParameterInfo& meaning) {
        if (meaning.name == ignored_number.name) {
            count += value != 0 ? 1 : 0;
            return true;
        }
        if (const auto& usual = meaning.slider) count += value < usual->low || value > usual->high ? 1 : 0;
        return value <= meaning.high && (meaning.open_low ? value > meaning.low : value >= meaning.low);
    };
    bool fine = look(scene.escape, fractal.escape);
    for (std::size_t i = 0; i < scene.shape.size(); ++i) fine = look(scene.shape[i], fractal.shape[i]) && fine;
    Scene as_that = scene;
    as_that.fractal = &fractal;
    return fine && fractal.objection(as_that).empty() ? std::optional(count) : std::nullopt;
}

// Returns the fractal for which the fewest values of the scene are unusual; nullptr if no fractal has fewer unusual
// values than the scene's own.
const Fractal* likelier(const Scene& scene)
{
    const Fractal* best = nullptr;
    int least = oddities(scene, *scene.fractal).value_or(0);
    for (const Fractal& other : fractals()) {
        const auto here = oddities(scene, other);
        if (!here || *here >= least) continue;
        least = *here;
        best = &other;
    }
    return best;
}

class Parser {
public:
    Parser(std::string_view text, const std::string& name, const Fractal& fractal)
        : rest_(text), name_(name), fractal_(fractal)
    {
        if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
    }

    ParameterFile parse()
    {
        Scene& scene = result_.scene;
        scene.fractal = &fractal_;
        scene.eye = vector(Item::eye, "camera location");
        scene.target = vector(Item::target, "look-at point");
        scene.up = vector(Item::up, "up vector");
        begin(Item::field_of_view, "field of view", 1);
        scene.field_of_view = real({"field of view, in units of 65 degrees,", 0, max_field_of_view, true});
        if (scene.field_of_view >= max_field_of_view) {
            fail("field of view, in units of 65 degrees, is 180 degrees or more, expected less than 180/65");
        }
        begin(Item::size, "width and height", 2);
        scene.width = whole("width", 1, max_side);
        scene.height = whole("height", 1, max_side);
        begin(Item::detail, "detail level", 1);
        scene.detail = single({"detail level", -37, 3});
        begin(Item::shape, "three numbers", 3);
        for (std::size_t i = 0; i < 3; ++i) scene.shape[i] = single(fractal_.shape[i]);
        begin(Item::iterations, "maximum of iterations and one more number", 2);
        scene.iterations = whole("maximum of iterations", 1, max_iterations);
        scene.escape = single(fractal_.escape);
        begin(Item::colouring, "colouring type", 1);
        scene.colouring = whole("colouring type", 0, colouring_types - 1);
        begin(Item::brightness, "brightness", 1);
        scene.brightness = single({"brightness", 0, 1e6});
        scene.image_file = file_name();
        if (next_line()) fail(fmt::format("{} follows the last entry, expected the end of the file", quoted(line_)));
        check_scene(scene, [this](Item item) { return place(lines_.at(static_cast<std::size_t>(item))); });
        warn_of_another_fractal();
        return std::move(result_);
    }

private:
    // Warns if the file seems to be made for another fractal: its comments do not name this fractal, and they name
    // another fractal, or its values suit another fractal better.
    void warn_of_another_fractal()
    {
        if (names(fractal_)) return;
        const auto named = std::ranges::find_if(fractals(), [this](const Fractal& one) { return names(one); });
        const Fractal* other = named != fractals().end() ? &*named : likelier(result_.scene);
        if (other == nullptr) return;
        result_.warnings.push_back(
            fmt::format("{}: warning: these {} suit a {} better than a {}, expected the file of a {}",
                        place(lines_.at(static_cast<std::size_t>(Item::shape))),
                        named != fractals().end() ? "comments" : "numbers", other->name, fractal_.name, fractal_.name));
    }

    bool names(const Fractal& fractal) const { return comments_.find(fractal.name) != std::string::npos; }

    std::string place(int line) const { return fmt::format("{}:{}", name_, line); }

    [[noreturn]] void fail(const std::string& text) const { throw InputError(place(number_) + ": " + text); }

    // Reads the next line that contains more than a comment. Returns false at the end of the text.
    bool next_line()
    {
        while (!rest_.empty()) {
            const auto end = rest_.find('\n');
            line_ = rest_.substr(0, end);
            rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
            ++number_;
            if (line_.find('\0') != std::string_view::npos) fail("the line holds a NUL byte, expected text");
            const std::string_view all = trimmed(line_);
            const std::string_view entry = without_comment(line_);
            std::ranges::transform(line_.substr(entry.size()), std::back_inserter(comments_),
                                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            line_ = trimmed(entry);
            commented_ = line_.size() < all.size();
            if (!line_.empty()) return true;
        }
        return false;
    }

    // Reads the line of an entry, which must have `count` values.
    void begin(Item item, const char* what, int count)
    {
        if (!next_line()) {
            number_ = std::max(number_, 1);
            fail(fmt::format("the file ends, expected {}", what));
        }
        lines_.at(static_cast<std::size_t>(item)) = number_;
        int words = 0;
        fields_ = line_;
        for (auto rest = line_; !rest.empty(); ++words) take_word(rest);
        if (words != count) {
            fail(fmt::format("{} value{} in {}, expected {} ({})", words, words == 1 ? "" : "s", quoted(line_), count,
                             what));
        }
    }

    static std::string_view take_word(std::string_view& rest)
    {
        const auto word = rest.substr(0, rest.find_first_of(blanks));
        rest = trimmed(rest.substr(word.size()));
        return word;
    }

    double real(const ParameterInfo& meaning)
    {
        const auto word = take_word(fields_);
        const auto value = parse_real(word);
        if (!value) fail(fmt::format("{} is {}, expected a decimal number", meaning.name, quoted(word)));
        check_range(*value, meaning, word);
        return *value;
    }

    // Reads a real number and rounds it to single precision. The rounded number must be in the range, too.
    double single(const ParameterInfo& meaning)
    {
        const auto word = fields_.substr(0, fields_.find_first_of(blanks));
        const auto value = real(meaning);
        if (meaning.high > 1e38) return value;  // an ignored number
        const double rounded = static_cast<float>(value);
        check_range(rounded, meaning, word);
        return rounded;
    }

    void check_range(double value, const ParameterInfo& meaning, std::string_view word) const
    {
        const bool low_enough = value <= meaning.high;
        const bool high_enough = meaning.open_low ? value > meaning.low : value >= meaning.low;
        if (low_enough && high_enough) return;
        fail(fmt::format("{} is {}, expected {} {:.6g} and at most {:.6g}", meaning.name, quoted(word),
                         meaning.open_low ? "more than" : "at least", meaning.low, meaning.high));
    }

    int whole(const char* what, int low, int high)
    {
        const auto word = take_word(fields_);
        const auto value = parse_whole(word);
        if (!value || *value < low || *value > high) {
            fail(fmt::format("{} is {}, expected a whole number from {} to {}", what, quoted(word), low, high));
        }
        return static_cast<int>(*value);
    }

    Vector vector(Item item, const char* what)
    {
        begin(item, what, 3);
        const ParameterInfo component{what, -1e9, 1e9};
        const double x = real(component);
        const double y = real(component);
        return {x, y, real(component)};
    }

    std::string file_name()
    {
        constexpr const char* what = "the image's file name";
        if (!next_line()) fail(fmt::format("the file ends, expected {}", what));
        if (const auto super_sampling = parse_real(line_)) {
            const bool off = *super_sampling == 0;
            const std::string number = quoted(line_);
            const std::string here = place(number_);
            if (!next_line()) fail(fmt::format("{} is no file name, expected {}", number, what));
            result_.super_sampling = !off;
            result_.warnings.push_back(fmt::format("{}: warning: {} taken as the super-sampling of an older format, {}",
                                                   here, number, off ? "which is off" : "for 2 x 2 samples a pixel"));
        }
        lines_.at(static_cast<std::size_t>(Item::image_file)) = number_;
        result_.comment_behind_name = commented_;
        if (line_.size() > 4096) fail(fmt::format("the line has {} characters, expected a file name", line_.size()));
        return std::string(line_);
    }

    std::string_view rest_;    // unread text
    std::string_view line_;    // the current line without blanks around it and without its comment
    std::string_view fields_;  // unread values of the current line
    bool commented_ = false;   // a comment follows the values of the current line
    int number_ = 0;           // number of the current line, counted from 1
    std::array<int, item_count> lines_{};
    std::string comments_;  // all comments, in lower case
    const std::string& name_;
    const Fractal& fractal_;
    ParameterFile result_;
};

bool reads_as(std::string_view text, const std::string& name, const Fractal& fractal)
{
    try {
        return Parser(text, name, fractal).parse().warnings.empty();
    } catch (const InputError&) {
        return false;
    }
}

}  // namespace

ParameterFile parse_parameters(std::string_view text, const std::string& name, const Fractal& fractal)
{
    try {
        return Parser(text, name, fractal).parse();
    } catch (const InputError& error) {
        for (const Fractal& other : fractals()) {
            if (&other == &fractal || !reads_as(text, name, other)) continue;
            throw InputError(fmt::format("{} (the file reads as one of a {})", error.what(), other.name));
        }
        throw;
    }
}

ParameterFile read_parameters(const std::string& path, const Fractal& fractal)
{
    return parse_parameters(text_of_file(path, "parameter file"), path, fractal);
}

Scene official_scene(const Fractal& fractal)
{
    return parse_parameters(fractal.official, fmt::format("the official scene of {}", fractal.name), fractal).scene;
}

Scene official_scene(const Fractal& fractal, int width, int height)
{
    Scene scene = official_scene(fractal);
    scene.width = width;
    scene.height = height;
    return scene;
}

std::string to_parameters(const Scene& scene)
{
    const auto vector = [](Vector v) { return fmt::format("{} {} {}", v.x, v.y, v.z); };
    return fmt::format(
        "# camera: location, look-at point, up vector, field of view\n{}\n{}\n{}\n{}\n"
        "# width and height, detail level\n{} {}\n{}\n"
        "# {}: {}, {}, {}; maximum of iterations, {}\n{} {} {}\n{} {}\n"
        "# colouring type, brightness, file\n{}\n{}\n{}\n",
        vector(scene.eye), vector(scene.target), vector(scene.up), scene.field_of_view, scene.width, scene.height,
        scene.detail, scene.fractal->name, scene.fractal->shape[0].name, scene.fractal->shape[1].name,
        scene.fractal->shape[2].name, scene.fractal->escape.name, scene.shape[0], scene.shape[1], scene.shape[2],
        scene.iterations, scene.escape, scene.colouring, scene.brightness, scene.image_file);
}

}  // namespace mandelmarch
