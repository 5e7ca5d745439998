// SPDX-License-Identifier: Apache-2.0
// Views: small depth maps of what a camera sees.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flight/field/field.h"
#include "flight/path/path.h"

namespace mandelmarch {

inline constexpr int view_width = 32;   // pixels
inline constexpr int view_height = 18;  // pixels
inline constexpr int view_pixels = view_width * view_height;

// The reason why a view shows little. empty: less than 15 % of the pixels hit something. one_depth: the depths of 95 %
// of the pixels differ by less than 25 %. wall: a wall closer than 2 clearances fills 90 % of the picture.
enum class Dullness { lively, empty, one_depth, wall };

struct DepthView {
    std::array<float, view_pixels> depth;  // along the ray, in the scene's units; +infinity: nothing hit

    double hit_share() const;
    // The same for the central pixels: without one eighth of the width or height on each side.
    double middle_hit_share() const;
    Dullness dullness(double clearance) const;
    bool dull(double clearance) const { return dullness(clearance) != Dullness::lively; }
};

// Returns the unit vector through the centre of a view's pixel.
Vector direction_of(const Camera& camera, int pixel);

// Returns the views of frames[0], frames[stride], ..., using all of the field's threads. The field must have the
// frames' shape.
std::vector<DepthView> views_of(const DistanceField& field, std::span<const Frame> frames, int stride);

// Returns the median motion of pixels from one frame to the next, in picture heights. `seen`: the view from the first
// frame. Only pixels that hit something count, as the background has one colour; if there are few, all pixels count.
double median_motion(const DepthView& seen, const Frame& from, const Frame& to);

// The same for rays from `from`, given by their unit vectors and depths (+infinity: nothing hit); 0 without rays.
double median_motion(std::span<const Vector> along, std::span<const float> depths, const Frame& from, const Frame& to);

// Returns the correlation of the logarithms of two views' depths, or of one view and the other mirrored, whichever is
// larger.
double likeness(const DepthView& a, const DepthView& b);

}  // namespace mandelmarch
