// SPDX-License-Identifier: Apache-2.0
// Views, which are small depth maps of what a camera sees, and the audit's items about them: motion, dullness and
// repetition.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flight/audit/audit.h"
#include "flight/field/field.h"
#include "flight/path/path.h"

namespace mandelmarch {

inline constexpr int view_width = 32;   // pixels
inline constexpr int view_height = 18;  // pixels
inline constexpr int view_pixels = view_width * view_height;

// Limits of the rays of views and of panoramas. A ray with more steps counts as a hit. Rays that pass an outer face of
// a Mandelbox closely take over 100 steps into the sky.
inline constexpr double farthest_seen = 12;  // fractal sizes; largest length
inline constexpr int most_steps = 250;

// The reason why a view is dull; `lively` if it is not.
// empty: less than 15 % of the pixels hit something.
// one_depth: the depths of 95 % of the pixels differ by less than 25 %.
// wall: 90 % of the pixels are closer than 2 clearances.
enum class Dullness { lively, empty, one_depth, wall };

struct DepthView {
    std::array<float, view_pixels> depth;  // along the ray, in the scene's units; +infinity: nothing hit

    // Returns the fraction of pixels that hit something.
    double hit_share() const;
    // Returns the fraction of central pixels that hit something. An eighth of the width or height is left out at each
    // edge.
    double middle_hit_share() const;
    // `clearance`: the clearance of the view's camera.
    Dullness dullness(double clearance) const;
};

// Returns the unit vector from the camera through the centre of a view's pixel.
Vector direction_of(const Camera& camera, int pixel);

// Returns the views of frames. `field`: the distance field of the frames' shape.
std::vector<DepthView> views_of(const DistanceField& field, std::span<const Frame> frames);
DepthView view_of(const DistanceField& field, const Frame& frame);

// Returns the median motion of pixels between the frames `from` and `to`, in picture heights. `seen`: the view of the
// frame `from`. If more than 2 % of the pixels hit something, only these pixels count, because the motion of a plain
// background is invisible. Otherwise all pixels count.
double median_motion(const DepthView& seen, const Frame& from, const Frame& to);

// Returns the median motion, in picture heights, of the points that the given rays hit; 0 if there are no rays. The
// rays start at `from.eye`. `along`: their unit vectors; `depths`: the distances of the hit points, +infinity if a ray
// hits nothing.
double median_motion(std::span<const Vector> along, std::span<const float> depths, const Frame& from, const Frame& to);

// The logarithms of a view's depths, less their mean. Pixels of the background are treated as twice as far away as the
// farthest hit.
struct LogDepths {
    explicit LogDepths(const DepthView& view);

    std::array<double, view_pixels> values;
    double squares;  // sum of the squares of the values
};

// Returns the correlation of two views' depths. It is computed with `b` as it is and with `b` mirrored left to right;
// the larger value is returned.
double likeness(const LogDepths& a, const LogDepths& b);

// Views of some frames: `views[i]` belongs to frame `frames[i]`.
struct Seen {
    int frames_per_second;
    std::vector<std::size_t> frames;
    std::vector<DepthView> views;
};

Row motion_row(const Path& path, const Seen& seen, int threads);

// Returns the percentage of dull frames, and the longest time during which all frames are dull. `clearances`: one for
// each frame of the path; `stride`: frames from one view to the next.
std::vector<Row> dull_rows(const Seen& seen, std::span<const double> clearances, std::size_t stride, int threads);

// Returns the percentage of frames that mostly show the background, and the longest time in which the fractal is only
// at the picture's edge.
std::vector<Row> subject_rows(const Seen& seen, std::size_t stride);

// A view and a later one that are the same, although a view between them is different.
struct Repeated {
    std::size_t frame;
    std::size_t later;
};

// Returns the views that are seen again within a minute, each with the first of its repetitions.
std::vector<Repeated> repeated_views(const Seen& seen, int threads);

}  // namespace mandelmarch
