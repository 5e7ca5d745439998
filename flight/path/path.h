// SPDX-License-Identifier: Apache-2.0
// The path of a flight: for each frame, the camera and the changes to the scene.
//     const Path path = read_path("path.json");
//     renderer.render(picture_of(path, path.frames[42], 1920, 1080), image);
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
    int every = 1;  // number of the flight's frames for each of these, if they are a quick motion; not in a path file
    bool detail_by_size = true;  // the detail level follows from the picture size; false: from scene.detail
    std::vector<Frame> frames;
};

// Returns the scene of one frame for a picture of width x height pixels. If detail_by_size and the frame does not set a
// detail level, the level is the decimal logarithm of the height of a pixel at distance 1, limited to -6 to -1.5.
Scene scene_of(const Path& path, const Frame& frame, int width, int height);

// Returns the scene of scene_of(), tuned for rendering if detail_by_size:
// - Iterations are limited to those that pixels of this size can show.
// - Steps are as long as the fractal's estimate allows in a close-up.
// - Hits are as exact as pixels of this size need.
// - Normals ignore features smaller than a pixel.
Scene picture_of(const Path& path, const Frame& frame, int width, int height);

// Rounds the camera numbers of all frames to the digits that a path file keeps, so that an audit measures the path as
// it is written.
void cut_digits(Path& path);

// Returns the path as JSON, one line per frame. The same path gives the same bytes.
std::string to_text(const Path& path);

// Parses a path file. Throws InputError if the JSON or a value is invalid; the message begins with `name`, the file's
// name, and counts frames from 0.
Path path_from_text(const std::string& text, const std::string& name);
Path read_path(const std::string& file);

// The camera's roll relative to a level horizon, for fractals that have an up and a down.
struct Tilt {
    double angle;    // rolling the frame by this angle makes it level; radians, -pi to pi, see rolled()
    double horizon;  // squared sine of the angle between gaze and vertical; 0: vertical gaze, `angle` is undefined
};

// Returns the tilt of a frame. `upward`: the unit vector that counts as upward.
Tilt tilt_of(const Frame& frame, Vector upward);
// Returns the tilt of a frame, with the upward direction that the fractal defines at the frame's eye.
Tilt tilt_of(const Frame& frame, const Fractal& fractal);

// Returns the sky of each frame, with the sun of a still. Its horizon follows the direction by which the camera is
// levelled, which the fractal defines at the frame's eye, but slowly.
std::vector<Sky> skies_of(const Path& path);

// Returns the frame with its camera rolled about its gaze by `angle` radians (right-hand rule).
Frame rolled(Frame frame, double angle);

// Returns the number of frames at the rate `from` that last as long as `frames` frames at the rate `to`. Rates are in
// frames per second.
int frames_at_rate(int frames, int from, int to);

// Returns the flight of `path` at `rate` frames per second: as many frames as it has time for, up to `frames`. The
// camera follows a cubic spline through the path's frames, so that its speed and acceleration are
// continuous. A changing shape is interpolated linearly between two frames. Camera numbers are rounded as in a path
// file. If `rate` is the path's rate, only the number of frames changes.
Path at_rate(const Path& path, int frames, int rate);

}  // namespace mandelmarch
