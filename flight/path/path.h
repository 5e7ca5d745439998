// SPDX-License-Identifier: Apache-2.0
// The path of a flight: every frame's camera and changes to the scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/scene.h"

namespace mandelmarch {

// The rate at which flights are planned; a path file may have another rate.
inline constexpr int frames_per_second = 30;
inline constexpr int most_frames_per_second = 240;

// A frame's changes to the path's scene, in the units of a parameter file.
struct Changes {
    std::optional<double> detail;
    std::optional<std::array<double, 3>> shape;
    std::optional<int> iterations;
    std::optional<double> escape;
    std::optional<int> colouring;
    std::optional<double> brightness;

    bool none() const { return !detail && !shape && !iterations && !escape && !colouring && !brightness; }
};

struct Frame {
    Vector eye, target, up;
    double field_of_view = 1;  // in units of 65 degrees, as in a parameter file
    Changes changes;
};

struct Path {
    Scene scene;  // shared by all frames, including the kind of estimate; its camera and size are unused
    std::uint64_t seed = 0;
    int frames_per_second = mandelmarch::frames_per_second;
    bool detail_by_size = true;  // the detail level follows from the picture size; false: it is the scene's
    std::vector<Frame> frames;
};

// Returns the scene of one frame at a picture size in pixels. If detail_by_size, its detail level is the decimal
// logarithm of one pixel height at distance 1, unless the frame sets a level.
Scene scene_of(const Path& path, const Frame& frame, int width, int height);

// The same, tuned for rendering if detail_by_size: iterations are limited to those that such pixels can show, steps are
// as long as the fractal's estimate allows in a close-up, hits are as exact as such pixels need, and normals ignore
// features smaller than a pixel.
Scene picture_of(const Path& path, const Frame& frame, int width, int height);

// Rounds every number of the path to the digits that a path file keeps, so that the audited path is the written one.
void cut_digits(Path& path);

// Returns the path as JSON, one line per frame. The same path gives the same bytes.
std::string to_text(const Path& path);

// Throws InputError if the JSON, a value or a frame (numbered from 0) is invalid. The message begins with `name`, the
// file's.
Path path_from_text(const std::string& text, const std::string& name);
Path read_path(const std::string& file);

}  // namespace mandelmarch
