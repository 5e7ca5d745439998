// SPDX-License-Identifier: Apache-2.0
#include "flight/film/frames.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "flight/film/shrink.h"
#include "flight/film/tent.h"

namespace mandelmarch {

namespace {

int samples_along(int pixels, double samples) { return static_cast<int>(std::lround(pixels * samples)); }

}  // namespace

RendererOptions without_trial(RendererOptions options)
{
    options.techniques.trial = false;
    return options;
}

Scene frame_scene(const Path& path, std::size_t frame, const Picture& picture)
{
    // The detail level follows the picture's pixels, not its samples: finer surfaces would flicker more, not less.
    Scene scene = picture_of(path, path.frames[frame], picture.width, picture.height);
    scene.width = samples_along(picture.width, picture.samples);
    scene.height = samples_along(picture.height, picture.samples);
    scene.centred = true;
    if (picture.look) scene.colouring = *picture.look;
    return scene;
}

void check_picture(const Picture& picture)
{
    const int width = samples_along(picture.width, picture.samples);
    const int height = samples_along(picture.height, picture.samples);
    constexpr std::uint64_t beside = 300ULL << 20;  // bytes: the program, the encoder and frames in flight
    const std::uint64_t needed = 3ULL * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) + beside;
    if (width <= max_side && height <= max_side && needed <= available_memory()) return;
    throw InputError(
        fmt::format("{} x {} pixels of {} x {} samples need {} MiB of memory and sides up to {}, expected "
                    "a smaller size",
                    picture.width, picture.height, picture.samples, picture.samples, needed >> 20, max_side));
}

FrameMaker::FrameMaker(const Backend& backend, const RendererOptions& options, const Path& path, const Picture& picture)
    : path_(path), picture_(picture), threads_(options.threads), renderer_(backend.create(without_trial(options)))
{
    check_picture(picture);
    image_ = Image(samples_along(picture.width, picture.samples), samples_along(picture.height, picture.samples),
                   Image::Layers::bytes);
}

std::vector<std::uint8_t> FrameMaker::draw(std::size_t frame)
{
    renderer_->render(frame_scene(path_, frame, picture_), image_);
    if (picture_.width == image_.width() && picture_.height == image_.height()) return softened(image_, threads_);
    return shrunk(image_, picture_.width, picture_.height, threads_);
}

}  // namespace mandelmarch
