// SPDX-License-Identifier: Apache-2.0
// A flight: the camera of every frame, and what may change from frame to frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

// The rate at which flights are planned; a path file may have another one.
inline constexpr int frames_per_second = 30;
inline constexpr int most_frames_per_second = 240;

// A frame's changes to the path's scene, as values of a parameter file.
struct Changes {
    std::optional<double> detail;
    std::optional<std::array<double, 3>> shape;
    std::optional<int> iterations;
    std::optional<double> escape;
    std::optional<int> colouring;
    std::optional<double> brightness;

    bool none() const { return !detail && !shape && !iterations && !escape && !colouring && !brightness; }
    bool of_shape() const { return shape || iterations || escape; }
};

struct Frame {
    Vector eye, target, up;
    double field_of_view = 1;  // in units of 65 degrees, as in a parameter file
    Changes changes;
};

struct Path {
    Scene scene;  // what all frames share, the estimate too; its camera and size mean nothing
    std::uint64_t seed = 0;
    int frames_per_second = mandelmarch::frames_per_second;
    bool detail_by_size = true;  // the detail level follows the pixel's footprint; else it is the scene's
    std::vector<Frame> frames;
};

// The scene of one frame at a picture size in pixels. Where the path leaves the detail level to the size, it is the
// logarithm of 0.7 pixel heights at distance 1.
Scene scene_of(const Path& path, const Frame& frame, int width, int height);

// The same to be drawn: where the detail level follows the size, no more iterations than such pixels can show are made,
// steps are as long as the fractal's estimate allows in a close-up, a hit is as exact as such pixels need, and normals
// see nothing that is smaller than they are.
Scene picture_of(const Path& path, const Frame& frame, int width, int height);

// The whole path with every number cut to the digits that a path file keeps, so that what is audited is what is
// written.
void cut_digits(Path& path);

// The path as JSON, one line a frame. The same path gives the same bytes.
std::string to_text(const Path& path);

// Throws InputError, with the file's name and what is wrong: with the JSON, a value, or a frame (by its number from 0).
Path path_from_text(const std::string& text, const std::string& name);
Path read_path(const std::string& file);

}  // namespace mandelmarch
