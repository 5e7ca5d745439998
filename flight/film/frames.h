// SPDX-License-Identifier: Apache-2.0
// Renders the frames of a path.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/render/backend.h"
#include "flight/path/path.h"

namespace mandelmarch {

// A look that replaces the path's: a colouring type, and, for a look file, its numbers.
struct ChosenLook {
    int colouring = default_look;
    std::optional<LookValues> values = std::nullopt;
};

struct Picture {
    int width = 1920;    // pixels
    int height = 1080;   // pixels
    double samples = 1;  // per pixel side, at least 1; 2: renders twice the size and averages 2 x 2 samples
    std::optional<ChosenLook> look;
    // Equirectangular pictures do not turn with the camera: up is always y, and the centre is always the horizontal
    // direction of the first frame's gaze.
    Projection projection = Projection::perspective;
    bool stereo = false;  // side by side; the eye distance is 1/30 of the clearance
};

// Returns the bytes that a film of these pictures needs in memory.
std::uint64_t memory_of(const Picture& picture);

// Throws InputError if the picture needs more than the available memory, or if a side is too long.
void check_picture(const Picture& picture);

// Returns the options without trials, which would choose another step factor for each frame of a film.
RendererOptions without_trial(RendererOptions options);

// Returns the scene of a frame as it is rendered: its width and height are counted in samples, and rays go through the
// samples' centres.
Scene frame_scene(const Path& path, std::size_t frame, const Picture& picture);

class FrameMaker {
public:
    // Creates one renderer for all frames. `path` must outlive this object. Throws Unavailable if the backend cannot
    // render with these options, and InputError as check_picture() does.
    FrameMaker(const Backend& backend, const RendererOptions& options, const Path& path, const Picture& picture);

    // Returns the frame's RGB bytes, top row first.
    std::vector<std::uint8_t> draw(std::size_t frame);

private:
    void render(std::size_t frame);

    const Path& path_;
    Picture picture_;
    int threads_;
    std::unique_ptr<Renderer> renderer_;
    Image image_;
};

}  // namespace mandelmarch
