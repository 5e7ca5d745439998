// SPDX-License-Identifier: Apache-2.0
// The pictures of a path, one after another, from one renderer.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/render/backend.h"
#include "flight/path/path.h"

namespace mandelmarch {

struct Picture {
    int width = 1920;         // pixels
    int height = 1080;        // pixels
    double samples = 1;       // per pixel and side, 1 or more: 2 draws at twice the size and takes means of 2 x 2
    std::optional<int> look;  // a colouring type instead of the path's
    // Equirectangular pictures do not turn with the camera: a viewer's head does. Their middle is where the first frame
    // looks, as far as that is level, and up is y.
    Projection projection = Projection::perspective;
    bool stereo = false;  // two eyes side by side, a thirtieth of the clearance apart
};

// Throws InputError where such a picture needs more memory than there is, or has sides that are too long.
void check_picture(const Picture& picture);

// How a film's renderer is made: a film never changes its steps from frame to frame, so that no trial chooses them.
RendererOptions without_trial(RendererOptions options);

// A frame as it is drawn, of the picture's samples, through their middles.
Scene frame_scene(const Path& path, std::size_t frame, const Picture& picture);

class FrameMaker {
public:
    // Keeps one renderer for all frames. Throws Unavailable, and what check_picture() throws.
    FrameMaker(const Backend& backend, const RendererOptions& options, const Path& path, const Picture& picture);

    // RGB, from the top row.
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
