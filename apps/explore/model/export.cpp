// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/export.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <vector>

#include "core/os/input_file.h"
#include "core/os/output_file.h"
#include "core/scene/fractal.h"
#include "core/scene/parameter_file.h"
#include "core/text/error.h"
#include "flight/path/path.h"
#include "flight/path/places.h"

namespace mandelmarch::explore {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text)
{
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

// Returns the fractal whose name occurs in the file's text (to_parameters() writes it as a comment) or, failing that,
// in the file's name. Returns `hint` if neither contains a name.
const Fractal& guess(const std::string& text, const std::string& name, const Fractal& hint)
{
    for (const std::string& where : {lower(text), lower(std::filesystem::path(name).filename().string())}) {
        for (const auto name_of : {&Fractal::name, &Fractal::short_name}) {
            for (const Fractal& fractal : fractals()) {
                if (where.find(fractal.*name_of) != std::string::npos) return fractal;
            }
        }
    }
    return hint;
}

}  // namespace

void as_file(Scene& scene)
{
    const Scene plain;
    scene.smooth = plain.smooth;
    scene.centred = plain.centred;
    scene.projection = plain.projection;
    scene.sun = plain.sun;
    scene.limits = plain.limits;
    scene.crop_window = plain.crop_window;
}

std::string view_text(const Scene& scene)
{
    std::string text = to_parameters(scene);
    if (scene.conservative) text = "# drawn with --estimate conservative\n" + text;
    return text;
}

std::string command_of(const Scene& scene, const Setup& setup, const std::string& file)
{
    return fmt::format("bin/render {} --fractal {} --backend {} --device {} --precision {} --mode {}{}", file,
                       scene.fractal->name, setup.backend, setup.device, mandelmarch::name_of(setup.precision),
                       mandelmarch::name_of(setup.mode), scene.conservative ? " --estimate conservative" : "");
}

std::string free_name(const std::string& folder, const std::string& stem)
{
    for (int number = 1;; ++number) {
        std::string name = fmt::format("{}{}{}-{:03}", folder, folder.empty() ? "" : "/", stem, number);
        const std::array endings{".dat", ".png", ".json", ".mp4"};
        if (std::ranges::none_of(endings, [&](auto ending) { return fs::exists(fs::symlink_status(name + ending)); }))
            return name;
    }
}

Scene view_of_text(const std::string& text, const std::string& name, const Fractal& hint)
{
    Scene scene = parse_parameters(text, name, guess(text, name, hint)).scene;
    scene.conservative = text.starts_with("# drawn with --estimate conservative");
    return scene;
}

std::size_t append_place(const std::string& file, const Scene& scene)
{
    std::string text = std::string(places_header) + "\n";
    if (std::filesystem::exists(file)) {
        text = text_of_file(file, "places file");
        if (!text.ends_with('\n')) text += '\n';
    }
    const std::string line = place_line(scene.eye, scene.target);
    text += line + "\n";
    const Places places = places_from_text(text, file);
    if (place_line(places.all.back().eye, places.all.back().target) != line) {
        throw InputError(fmt::format("{}: columns in another order, expected {}", file, places_header));
    }
    write_file(file, text);
    return places.all.size();
}

Scene read_view(const std::string& file, const Fractal& hint)
{
    return view_of_text(text_of_file(file, "parameter file"), file, hint);
}

std::span<const StartView> start_views()
{
    static const std::vector<StartView> embedded{
#include "start_views.inc"
    };
    return embedded;
}

}  // namespace mandelmarch::explore
