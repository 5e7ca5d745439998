// SPDX-License-Identifier: Apache-2.0
// What a camera sees, in few pixels: the depths of a small picture.
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

// Why a view shows little: under 15 % of the pixels hit something, 95 % of the depths lie within a quarter of each
// other, or a wall nearer than 2 clearances fills nine tenths of the picture.
enum class Dullness { lively, empty, one_depth, wall };

struct Glimpse {
    std::array<float, view_pixels> depth;  // along the ray, in the scene's units; +infinity: nothing hit

    double hit_share() const;
    // Of the pixels that are not in the outer quarter of the width or of the height: an eighth on each side.
    double middle_hit_share() const;
    Dullness dullness(double clearance) const;
    bool dull(double clearance) const { return dullness(clearance) != Dullness::lively; }
};

// The unit vector through a pixel of a view.
Vector direction_of(const Camera& camera, int pixel);

// Views of frames[0], frames[stride], ..., on all of the field's threads. The field must have the frames' shape.
std::vector<Glimpse> views_of(const Field& field, std::span<const Frame> frames, int stride);

// Pixels move by this much, in picture heights, from one frame to the next: the median over the pixels of the view
// `seen` from the first that hit something, as the background has one colour; over all of them where few do.
double median_motion(const Glimpse& seen, const Frame& from, const Frame& to);

// The same of rays from `from`, given by their unit vectors and depths (+infinity: nothing hit); 0 of none.
double median_motion(std::span<const Vector> along, std::span<const float> depths, const Frame& from, const Frame& to);

// The correlation of two views' logarithms of depth, of one as it is or mirrored, whichever is larger.
double likeness(const Glimpse& a, const Glimpse& b);

}  // namespace mandelmarch
