// SPDX-License-Identifier: Apache-2.0
#include "apps/survey.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "core/image/compare.h"
#include "core/instruments/trace.h"
#include "core/os/output_file.h"
#include "core/render/stereo.h"
#include "core/render/trial.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"

namespace mandelmarch {
namespace {

constexpr double many_out_of_steps = 0.02;  // fraction of the rays above which the user is warned
constexpr double much_lost = 0.1;           // fraction of the pixels above which the user is warned

Image drawn_by(Renderer& renderer, const Scene& scene)
{
    Image image(scene.width, scene.height, Image::Layers::all);
    renderer.render(scene, image);
    return image;
}

// Returns true if the eye is inside the solid: if the orbit of the first sample of a ray does not escape. The ray is
// traced in double and exact mode, in which the first sample lies at the eye.
bool stands_in_solid(Scene scene)
{
    scene.limits = {};
    const Trace trace = trace_pixel(scene, {.precision = Precision::f64, .mode = Mode::exact}, 0, 0);
    return !trace.marching.empty() && trace.marching.front().iterations >= scene.iterations;
}

Survey survey_of_one(const Scene& scene, const RendererOptions& options, Renderer& renderer, const Backend& other)
{
    const Scene small = trial_scene(scene);
    const Image picture = drawn_by(renderer, small);
    Survey survey{.rays = static_cast<int>(picture.pixels())};
    const auto share_of = [&](const auto& counts) {
        return static_cast<double>(std::ranges::count_if(picture.values(), counts)) / survey.rays;
    };
    survey.hit = share_of([](const PixelValue& pixel) { return std::isfinite(pixel.depth); });
    survey.out_of_steps =
        share_of([](const PixelValue& pixel) { return !std::isfinite(pixel.depth) && pixel.steps >= max_steps; });
    survey.inside = stands_in_solid(small);
    if (options.precision == Precision::f32) {
        const auto in_double = other.create({.mode = options.mode, .techniques = options.techniques});
        const Comparison compared = compare(picture, drawn_by(*in_double, small));
        survey.lost = static_cast<double>(compared.visibly_differing) / survey.rays;
    }
    return survey;
}

}  // namespace

bool has_one_colour(const Image& image)
{
    const auto& bytes = image.bytes();
    return std::equal(bytes.begin() + 3, bytes.end(), bytes.begin());
}

Survey survey_of(const Scene& scene, double eyes, const RendererOptions& options, Renderer& renderer,
                 const Backend& other)
{
    if (eyes <= 0) return survey_of_one(scene, options, renderer, other);
    const Survey left = survey_of_one(of_eye(scene, eyes, -1), options, renderer, other);
    const Survey right = survey_of_one(of_eye(scene, eyes, 1), options, renderer, other);
    return {.rays = left.rays + right.rays,
            .hit = (left.hit + right.hit) / 2,
            .out_of_steps = (left.out_of_steps + right.out_of_steps) / 2,
            .inside = left.inside && right.inside,
            .lost = (left.lost + right.lost) / 2};
}

void refuse_solid(const Survey& survey, bool one_colour, const std::string& where)
{
    if (!survey.inside || !one_colour) return;
    throw InputError(fmt::format(
        "{}: the camera is inside the solid, so the picture shows nothing, expected a place outside", where));
}

std::vector<std::string> words_of(const Survey& survey, const Scene& scene, bool one_colour)
{
    std::vector<std::string> words;
    if (survey.lost > much_lost) {
        words.push_back(fmt::format(
            "float's digits are too few for this view: {:.0f} % of the picture is off, expected --precision double",
            100 * survey.lost));
    }
    if (survey.inside && survey.hit > 0.99) words.emplace_back("the camera is inside the solid");
    if (survey.out_of_steps > many_out_of_steps) {
        words.push_back(fmt::format(
            "{:.0f} % of the rays ran out of their {} steps and show the background: the detail level {:.6g} "
            "may be too fine, or steps too short",
            100 * survey.out_of_steps, max_steps, scene.detail));
    } else if (one_colour && survey.hit == 0) {
        words.push_back(
            fmt::format("nothing was hit: the picture shows the background alone; the camera stands {:.4g} "
                        "from the middle of the {}",
                        length(scene.eye), scene.fractal->name));
    } else if (one_colour) {
        words.emplace_back("the picture has one colour");
    }
    return words;
}

std::string view_warning(const Scene& scene, double clearance, Precision precision, bool one_colour)
{
    const double farthest = std::max({std::abs(scene.eye.x), std::abs(scene.eye.y), std::abs(scene.eye.z)});
    const double tolerance = std::pow(10, scene.detail);  // tolerance of a hit at distance 1
    if (one_colour) {
        // The eye is taken to be inside the solid if the estimate is at most the tolerance of a hit at the distance of
        // the fractal's centre.
        if (clearance <= tolerance * farthest) return "the camera is inside the solid";
        return "nothing is in view: the picture has one colour";
    }
    // Rounding to float moves the eye by up to half a unit in the last place. The picture is wrong if this motion
    // exceeds the tolerance of a hit on the nearest surface, which is at the distance `clearance`.
    if (precision == Precision::f32 && farthest * 0x1p-24 > tolerance * clearance) {
        return "float's digits are too few so near to the surface: draw in double";
    }
    return {};
}

void write_stats(const std::string& path, const Scene& scene, const RenderStats& report, const Survey& survey,
                 const std::vector<std::string>& warnings)
{
    const Timings& t = report.timings;
    auto kernels = nlohmann::ordered_json::array();
    for (const KernelResources& k : report.kernels) {
        kernels.push_back({{"name", k.kernel}, {"registers", k.registers}, {"local_bytes", k.local_bytes}});
    }
    const nlohmann::ordered_json json{
        {"schema", 1},
        {"fractal", scene.fractal->name},
        {"width", scene.width},
        {"height", scene.height},
        {"backend", report.backend},
        {"device",
         {{"name", report.device.name},
          {"vendor", report.device.vendor},
          {"driver", report.device.driver},
          {"is_gpu", report.device.is_gpu}}},
        {"precision", name_of(report.precision)},
        {"mode", name_of(report.mode)},
        {"threads", report.threads},
        {"simd_width", report.simd_width},
        {"instruction_set", report.instruction_set},
        {"step_factor", report.step_factor > 0 ? nlohmann::ordered_json(report.step_factor) : nlohmann::ordered_json()},
        {"unsettled", report.unsettled},
        {"survey",
         {{"rays", survey.rays},
          {"hit", survey.hit},
          {"out_of_steps", survey.out_of_steps},
          {"in_solid", survey.inside},
          {"lost_in_float", survey.lost}}},
        {"warnings", warnings},
        {"seconds",
         {{"context", t.context},
          {"build", t.build},
          {"upload", t.upload},
          {"kernel", t.kernel},
          {"trial", t.trial},
          {"host", t.host},
          {"readback", t.readback},
          {"wall", t.wall}}},
        {"work",
         {{"steps", report.work.steps}, {"de_calls", report.work.de_calls}, {"iterations", report.work.iterations}}},
        {"kernels", kernels},
    };
    // A driver's name is not always valid UTF-8.
    write_file(path, json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace mandelmarch
