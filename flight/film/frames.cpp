// SPDX-License-Identifier: Apache-2.0
#include "flight/film/frames.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/text/error.h"
#include "core/os/memory.h"
#include "core/render/stereo.h"
#include "flight/field/field.h"
#include "flight/film/shrink.h"

namespace mandelmarch {
namespace {

constexpr double eyes_distance = 1.0 / 30;  // clearances; the 1/30 rule of stereo for objects one clearance away

// Returns the frame with a level camera for a picture that shows all directions. The field of view then only serves to
// compute the height of a pixel: the picture's height, which is an angle of pi, counts as a height of pi on a plane at
// distance 1.
Frame looking_everywhere(const Path& path, Frame frame)
{
    const Frame& first = path.frames.front();
    const Vector level{first.target.x - first.eye.x, 0, first.target.z - first.eye.z};
    frame.target =
        frame.eye + (length(level) > 1e-3 * length(first.target - first.eye) ? unit(level) : Vector{0, 0, 1});
    frame.up = {0, 1, 0};
    frame.field_of_view = 2 * std::atan(std::numbers::pi / 2) * 180 / std::numbers::pi / degrees_per_field;
    return frame;
}

constexpr int directions = 24;            // number of candidate directions for the sun
constexpr std::size_t frames_apart = 30;  // frames from one compared frame to the next
constexpr double against = 0.5;           // weight of a sun in front of the camera; one behind it has weight 1

// Returns the quality of a frame's light: 1 for a sun at right angles to the gaze, 0 for one along it.
double worth(Vector sun, Vector gaze)
{
    const double cosine = dot(sun, gaze);
    return (1 - cosine * cosine) * (cosine > 0 ? against : 1);
}

// Returns a unit vector at this height above the horizon. Both angles are in radians.
Vector sun_at(double height, double azimuth)
{
    return {std::cos(height) * std::sin(azimuth), std::sin(height), std::cos(height) * std::cos(azimuth)};
}

// Returns the direction of a sun that shines in the whole film. It is chosen so that most frames are lit from the side,
// which shows relief best, and rather from behind the camera than from the front.
Vector steady_sun(const Path& path, double height)
{
    Vector best = sun_at(height, 0);
    double most = 0;
    for (int i = 0; i < directions; ++i) {
        const Vector sun = sun_at(height, 2 * std::numbers::pi * i / directions);
        double sum = 0;
        for (std::size_t frame = 0; frame < path.frames.size(); frame += frames_apart) {
            sum += worth(sun, unit(path.frames[frame].target - path.frames[frame].eye));
        }
        if (sum > most) {
            most = sum;
            best = sun;
        }
    }
    return best;
}

constexpr double window = 20;      // seconds; gazes of frames at most this far away turn the sun of a frame
constexpr double beside_it = 110;  // degrees from the mean gaze to the sun, to the right

// Returns the direction of a sun that turns with the way: it is beside the mean gaze of the frames near `frame`, a
// little behind it. Frames count less the farther away they are, so that the sun moves smoothly.
Vector following_sun(const Path& path, double height, std::size_t frame)
{
    const auto second = static_cast<std::size_t>(path.frames_per_second);
    const double reach = window * path.frames_per_second;
    Vector mean{0, 0, 0};
    for (std::size_t i = 0; i < path.frames.size(); i += second) {
        const double weight = 1 - std::abs(static_cast<double>(i) - static_cast<double>(frame)) / reach;
        if (weight > 0) mean = mean + weight * unit(path.frames[i].target - path.frames[i].eye);
    }
    return sun_at(height, std::atan2(mean.x, mean.z) - beside_it * std::numbers::pi / 180);
}

Vector sun_of(const Path& path, const LookValues& look, std::size_t frame)
{
    const double height = look.sun_height() * std::numbers::pi / 180;
    return look.sun_follows() ? following_sun(path, height, frame) : steady_sun(path, height);
}

int samples_along(int pixels, double samples) { return static_cast<int>(std::lround(pixels * samples)); }

}  // namespace

RendererOptions without_trial(RendererOptions options)
{
    options.techniques.trial = false;
    return options;
}

Scene frame_scene(const Path& path, std::size_t frame, const Picture& picture)
{
    // The detail level is computed from the size in pixels, not in samples, because finer surfaces flicker more.
    const bool everywhere = picture.projection == Projection::equirectangular;
    const Frame& flown = path.frames[frame];
    Scene scene = picture_of(path, everywhere ? looking_everywhere(path, flown) : flown, picture.width, picture.height);
    scene.projection = picture.projection;
    scene.width = samples_along(picture.width, picture.samples);
    scene.height = samples_along(picture.height, picture.samples);
    scene.centred = true;
    if (picture.look) {
        scene.colouring = picture.look->colouring;
        scene.look = picture.look->values;
    }
    if (const LookValues* look = look_of(scene)) scene.sun = sun_of(path, *look, frame);
    return scene;
}

std::uint64_t memory_of(const Picture& picture)
{
    constexpr std::uint64_t beside = 300ULL << 20;  // bytes for the program, the encoder and buffered frames
    const auto width = static_cast<std::uint64_t>(samples_along(picture.width, picture.samples));
    const auto height = static_cast<std::uint64_t>(samples_along(picture.height, picture.samples));
    return 3 * width * height + beside;
}

void check_picture(const Picture& picture)
{
    const int width = samples_along(picture.width, picture.samples);
    const int height = samples_along(picture.height, picture.samples);
    const std::string size = fmt::format("{} x {} pixels of {} x {} samples", picture.width, picture.height,
                                         picture.samples, picture.samples);
    if (width > max_side || height > max_side) {
        throw InputError(fmt::format("{} have a side of more than {}, expected a smaller size", size, max_side));
    }
    const std::string lack = memory_shortage(size, memory_of(picture));
    if (!lack.empty()) throw InputError(lack + ", expected a smaller size");
}

FrameMaker::FrameMaker(const Backend& backend, const RendererOptions& options, const Path& path, const Picture& picture)
    : path_(path), picture_(picture), threads_(options.threads), renderer_(backend.create(without_trial(options)))
{
    check_picture(picture);
    image_ = Image(samples_along(picture.width, picture.samples), samples_along(picture.height, picture.samples),
                   Image::Layers::bytes);
}

void FrameMaker::render(std::size_t frame)
{
    const Scene scene = frame_scene(path_, frame, picture_);
    if (picture_.stereo) {
        const double clearance = DistanceField(scene, 1).distance(scene.eye);
        render_stereo(*renderer_, scene, eyes_distance * clearance, image_);
    } else {
        renderer_->render(scene, image_);
    }
}

std::vector<std::uint8_t> FrameMaker::draw(std::size_t frame)
{
    render(frame);
    if (picture_.width == image_.width() && picture_.height == image_.height()) return softened(image_, threads_);
    return shrunk(image_, picture_.width, picture_.height, threads_);
}

}  // namespace mandelmarch
