// SPDX-License-Identifier: Apache-2.0
#include "flight/film/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/image/averaged.h"
#include "core/os/memory.h"
#include "core/render/stereo.h"
#include "core/text/error.h"
#include "flight/field/field.h"
#include "flight/field/threads.h"

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

constexpr double direction_pitch = 15;    // degrees from one candidate direction for the sun to the next
constexpr std::size_t frames_apart = 30;  // frames from one compared frame to the next
constexpr double against = 0.5;           // weight of a sun in front of the camera; one behind it has weight 1

// Returns the quality of a frame's light: 1 for a sun at right angles to the gaze, 0 for one along it.
double worth(Vector sun, Vector gaze)
{
    const double cosine = dot(sun, gaze);
    return (1 - cosine * cosine) * (cosine > 0 ? against : 1);
}

// Returns the azimuth, to the right of north, of a sun that stands still in the sky of the whole film. It is chosen so
// that most frames are lit from the side, which shows relief best, and rather from behind the camera than from the
// front.
double steady_azimuth(const Path& path, double height, const std::vector<Sky>& skies)
{
    double best = 0;
    double most = 0;
    for (double azimuth = 0; azimuth < 360; azimuth += direction_pitch) {
        double sum = 0;
        for (std::size_t frame = 0; frame < path.frames.size(); frame += frames_apart) {
            const Vector sun = sun_at(skies[frame], skies[frame].north, height, azimuth);
            sum += worth(sun, unit(path.frames[frame].target - path.frames[frame].eye));
        }
        if (sum > most) {
            most = sum;
            best = azimuth;
        }
    }
    return best;
}

constexpr double window = 20;  // seconds; gazes of frames at most this far away turn the sun of a frame

// Returns the sum of the gazes of the frames near `frame`. Frames count less the farther away they are, so that a sun
// beside it moves smoothly.
Vector mean_gaze(const Path& path, std::size_t frame)
{
    const auto second = static_cast<std::size_t>(path.frames_per_second);
    const double reach = window * path.frames_per_second;
    Vector mean{0, 0, 0};
    for (std::size_t i = 0; i < path.frames.size(); i += second) {
        const double weight = 1 - std::abs(static_cast<double>(i) - static_cast<double>(frame)) / reach;
        if (weight > 0) mean = mean + weight * unit(path.frames[i].target - path.frames[i].eye);
    }
    return mean;
}

// Returns the direction of a frame's sun.
Vector sun_of(const Path& path, std::size_t frame, const LookValues& look, const std::vector<Sky>& skies)
{
    const Sky& sky = skies[frame];
    const double height = look.sun_height();
    return look.sun_azimuth() > 0 ? sun_at(sky, mean_gaze(path, frame), height, look.sun_azimuth())
                                  : sun_at(sky, sky.north, height, steady_azimuth(path, height, skies));
}

int samples_along(int pixels, double samples) { return static_cast<int>(std::lround(pixels * samples)); }

constexpr unsigned middle = 6;  // weight of the pixel itself, in tenths; each of its four neighbours has one tenth
constexpr unsigned tenths = 10;
constexpr std::size_t grain = 16;  // rows that a thread takes at once

// The part of a sample that lies in a pixel.
struct Share {
    std::size_t sample;
    std::uint64_t weight;
};

// The weights with which `samples` samples are averaged to `pixels` pixels along one side of the picture. Pixel i is
// the weighted mean of the shares all[first[i]] to all[first[i + 1] - 1]. The weights of these shares add up to
// `whole`.
struct Shares {
    std::vector<Share> all;
    std::vector<std::size_t> first;
    std::uint64_t whole = 0;

    Shares(int samples, int pixels)
    {
        const auto common = static_cast<std::uint64_t>(std::gcd(samples, pixels));
        // Lengths are integers in a common unit: a sample is `sample` long, a pixel is `whole` long.
        const std::uint64_t sample = static_cast<std::uint64_t>(pixels) / common;
        whole = static_cast<std::uint64_t>(samples) / common;
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(pixels); ++i) {
            first.push_back(all.size());
            for (std::uint64_t at = i * whole; at < (i + 1) * whole;) {
                const std::uint64_t next = std::min((at / sample + 1) * sample, (i + 1) * whole);
                all.push_back({static_cast<std::size_t>(at / sample), next - at});
                at = next;
            }
        }
        first.push_back(all.size());
    }
};

}  // namespace

RendererOptions without_trial(RendererOptions options)
{
    options.techniques.trial = false;
    return options;
}

// In panoramas, whose cameras are upright, the sky's upward direction is always y.
FrameScenes::FrameScenes(const Path& path, const Picture& picture)
    : path_(path),
      picture_(picture),
      skies_(picture.projection == Projection::equirectangular ? std::vector<Sky>(path.frames.size()) : skies_of(path))
{
}

Scene FrameScenes::scene(std::size_t frame) const
{
    // The detail level is computed from the size in pixels, not in samples, because finer surfaces flicker more.
    const bool everywhere = picture_.projection == Projection::equirectangular;
    const Frame& flown = path_.frames[frame];
    Scene scene =
        picture_of(path_, everywhere ? looking_everywhere(path_, flown) : flown, picture_.width, picture_.height);
    scene.projection = picture_.projection;
    scene.width = samples_along(picture_.width, picture_.samples);
    scene.height = samples_along(picture_.height, picture_.samples);
    scene.centred = true;
    scene.grainy = picture_.format != ImageFormat::exr;
    if (picture_.look) {
        scene.colouring = picture_.look->colouring;
        scene.look = picture_.look->values;
    }
    if (const LookValues* look = look_of(scene)) {
        scene.sky = skies_[frame];
        scene.sky.sun = sun_of(path_, frame, *look, skies_);
    }
    return scene;
}

std::uint64_t memory_of(const Picture& picture)
{
    constexpr std::uint64_t beside = 300ULL << 20;  // bytes for the program, the encoder and buffered frames
    const auto width = static_cast<std::uint64_t>(samples_along(picture.width, picture.samples));
    const auto height = static_cast<std::uint64_t>(samples_along(picture.height, picture.samples));
    const std::uint64_t images = picture.format == ImageFormat::exr ? 2 : 1;  // the samples, and their means
    return images * Image::bytes_per_pixel(layers_of(picture.format)) * width * height + beside;
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
    if (picture.format == ImageFormat::exr && picture.samples != std::floor(picture.samples)) {
        throw InputError(fmt::format("--samples: {} given, expected a whole number for EXR stills", picture.samples));
    }
    const std::string lack = memory_shortage(size, memory_of(picture));
    if (!lack.empty()) throw InputError(lack + ", expected a smaller size");
}

FrameMaker::FrameMaker(const Backend& backend, const RendererOptions& options, const Path& path, const Picture& picture)
    : scenes_(path, picture),
      picture_(picture),
      threads_(options.threads),
      renderer_(backend.create(without_trial(options)))
{
    check_picture(picture);
    image_ = Image(samples_along(picture.width, picture.samples), samples_along(picture.height, picture.samples),
                   layers_of(picture.format));
}

void FrameMaker::render(std::size_t frame)
{
    const Scene scene = scenes_.scene(frame);
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

Image FrameMaker::draw_layers(std::size_t frame)
{
    render(frame);
    return averaged(image_, static_cast<int>(picture_.samples));
}

std::vector<std::uint8_t> shrunk(const Image& picture, int width, int height, int threads)
{
    const Shares across(picture.width(), width);
    const Shares down(picture.height(), height);
    const std::uint64_t whole = across.whole * down.whole;
    const auto rows = static_cast<std::size_t>(height);
    const std::size_t pitch = 3 * static_cast<std::size_t>(width);
    const std::size_t from_pitch = 3 * static_cast<std::size_t>(picture.width());
    std::vector<std::uint8_t> rgb(rows * pitch);
    parallel(rows, grain, threads, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint64_t> sums(pitch);
        for (std::size_t y = begin; y < end; ++y) {
            sums.assign(pitch, whole / 2);
            for (std::size_t j = down.first[y]; j < down.first[y + 1]; ++j) {
                const auto row = static_cast<std::size_t>(picture.height()) - 1 - down.all[j].sample;
                const std::uint8_t* from = picture.bytes().data() + row * from_pitch;
                for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
                    for (std::size_t i = across.first[x]; i < across.first[x + 1]; ++i) {
                        const std::uint64_t weight = across.all[i].weight * down.all[j].weight;
                        const std::uint8_t* sample = from + 3 * across.all[i].sample;
                        for (std::size_t c = 0; c < 3; ++c) sums[3 * x + c] += weight * sample[c];
                    }
                }
            }
            for (std::size_t i = 0; i < pitch; ++i) rgb[y * pitch + i] = static_cast<std::uint8_t>(sums[i] / whole);
        }
    });
    return rgb;
}

std::vector<std::uint8_t> softened(const Image& picture, int threads)
{
    const auto rows = static_cast<std::size_t>(picture.height());
    const std::size_t pitch = 3 * static_cast<std::size_t>(picture.width());
    std::vector<std::uint8_t> rgb(rows * pitch);
    const std::uint8_t* bytes = picture.bytes().data();
    parallel(rows, grain, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y) {
            const std::uint8_t* here = bytes + (rows - 1 - y) * pitch;
            const std::uint8_t* above = y > 0 ? here + pitch : here;
            const std::uint8_t* below = y + 1 < rows ? here - pitch : here;
            std::uint8_t* to = rgb.data() + y * pitch;
            const auto mixed = [&](std::size_t i, std::size_t left, std::size_t right) {
                // The sum has 16 bits, so that a vector register holds many sums.
                const auto sum = static_cast<std::uint16_t>(middle * here[i] + here[left] + here[right] + above[i] +
                                                            below[i] + tenths / 2);
                return static_cast<std::uint8_t>(sum / tenths);
            };
            for (std::size_t i = 0; i < 3; ++i) to[i] = mixed(i, i, std::min(i + 3, pitch - 3 + i));
            for (std::size_t i = 3; i + 3 < pitch; ++i) to[i] = mixed(i, i - 3, i + 3);
            for (std::size_t i = std::max<std::size_t>(pitch - 3, 3); i < pitch; ++i) to[i] = mixed(i, i - 3, i);
        }
    });
    return rgb;
}

}  // namespace mandelmarch
