// SPDX-License-Identifier: Apache-2.0
// Renders the frames of a path. If there are several samples per pixel, a pixel is their mean. If there is one sample
// per pixel, a filter is applied to the samples.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/image/formats/image_file.h"
#include "core/image/image.h"
#include "core/render/backend.h"
#include "flight/path/path.h"

namespace mandelmarch {

struct Picture {
    int width = 1920;    // pixels
    int height = 1080;   // pixels
    double samples = 1;  // per pixel side, at least 1; 2: renders twice the size and averages 2 x 2 samples
    std::optional<ChosenLook> look;
    // Equirectangular pictures do not turn with the camera: up is always y, and the centre is always the horizontal
    // direction of the first frame's gaze.
    Projection projection = Projection::perspective;
    bool stereo = false;                    // side by side; the eye distance is 1/30 of the clearance
    ImageFormat format = ImageFormat::png;  // of stills: png, jpeg or exr
};

// Returns the bytes that a film of these pictures needs in memory.
std::uint64_t memory_of(const Picture& picture);

// Throws InputError if the picture needs more than the available memory, if a side is too long, or if pixels of an EXR
// picture share samples.
void check_picture(const Picture& picture);

// Returns the options without trials, which would choose another step factor for each frame of a film.
RendererOptions without_trial(RendererOptions options);

// The scenes of a film's frames as they are rendered: width and height are counted in samples, and rays go through the
// samples' centres. `path` must outlive this object.
class FrameScenes {
public:
    FrameScenes(const Path& path, const Picture& picture);
    Scene scene(std::size_t frame) const;

private:
    const Path& path_;
    Picture picture_;
    std::vector<Sky> skies_;  // without the suns of looks
};

class FrameMaker {
public:
    // Creates one renderer for all frames. `path` must outlive this object. Throws Unavailable if the backend cannot
    // render with these options, and InputError as check_picture() does.
    FrameMaker(const Backend& backend, const RendererOptions& options, const Path& path, const Picture& picture);

    // Returns the frame's RGB bytes, top row first.
    std::vector<std::uint8_t> draw(std::size_t frame);
    // Returns the frame with the layers of the picture's format. Pixels are means of their samples, without a filter.
    Image draw_layers(std::size_t frame);

private:
    void render(std::size_t frame);

    FrameScenes scenes_;
    Picture picture_;
    int threads_;
    std::unique_ptr<Renderer> renderer_;
    Image image_;
};

// Returns the RGB bytes of `width` x `height` pixels, top row first. Each byte is the mean of the samples in the
// pixel's area, rounded to nearest (halves up). A sample that lies in several pixels is weighted by its area in each.
// The picture must be at least as large as the result. Uses up to `threads` threads.
std::vector<std::uint8_t> shrunk(const Image& picture, int width, int height, int threads);

// Returns the filtered picture's RGB bytes, top row first. Each byte is 6/10 of the pixel's own value plus 1/10 of each
// of its four neighbours' values, rounded to nearest (halves up). At the edges, the pixel itself replaces a missing
// neighbour. The filter removes the flicker of single samples and costs a twentieth of the sharpness
// (docs/notes/experiments.md). Uses up to `threads` threads.
std::vector<std::uint8_t> softened(const Image& picture, int threads);

}  // namespace mandelmarch
