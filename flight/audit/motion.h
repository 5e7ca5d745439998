// SPDX-License-Identifier: Apache-2.0
// Computes turns, jerk, roll, standing still, narrow places and chapters of a path from its cameras and their
// clearances.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "flight/audit/audit.h"
#include "flight/field/field.h"
#include "flight/path/path.h"

namespace mandelmarch {

// Returns, for each frame, the angle in degrees by which the camera has rotated since the previous frame, including
// roll; 0 for the first frame.
std::vector<double> turns_of(const Path& path);

// Returns the 95th percentiles of the jerk (third differences of the position, in clearances / s^3) and of the angular
// jerk (second differences of the rotation between frames, in degrees / s^3). `clearances`: one per frame.
std::vector<Row> jerk_rows(const Path& path, std::span<const double> clearances);

// Returns the percentage of frames that are within 30 degrees of level. Only frames whose gaze is at least 30 degrees
// from vertical count.
Row level_row(const Path& path);

// A stretch of frames in which the camera stays within a radius of its place in the first frame.
struct Stand {
    std::size_t first = 0;      // index of the first frame
    std::size_t steps = 0;      // number of consecutive frames after the first that lie within the radius
    std::size_t distances = 0;  // number of distances that the search computed
};

// Returns the longest stand, or the first of several equally long ones. places[first + 1] to places[first + steps] are
// at most radii[first] away from places[first]. If the camera stands still or moves steadily, the running time is
// proportional to the number of places.
Stand longest_stand(std::span<const Vector> places, std::span<const double> radii);

// The estimate, in fractal sizes, up to which a point counts as solid.
inline constexpr double in_solid = 1e-5;

// A place at which a path's clearance falls to half or less and then at least doubles.
struct Passage {
    std::size_t frame;  // the passage's frame with the smallest clearance
    double clearance;
};

// A function that returns the distance field of a frame.
using FieldOf = std::function<const DistanceField&(std::size_t frame)>;

// Returns the passages inside the bounds, from the positions and clearances of a path's frames. A passage is left out
// if it is close to an earlier one, or if the fractal's symmetry maps it to a place close to an earlier one.
std::vector<Passage> distinct_passages(const FieldOf& field, std::span<const Vector> places,
                                       std::span<const double> clearances);

// Consecutive frames whose shape, iterations and escape radius are the same, and their distance field.
struct Run {
    std::size_t first, last;  // frames [first, last)
    std::unique_ptr<DistanceField> field;
};

// The successive shapes of a path.
class Runs {
public:
    // `threads`: 0 for as many as the process may use.
    Runs(const Path& path, int threads);

    bool changes() const { return runs_.size() > 1; }
    const DistanceField& field(std::size_t frame) const { return *runs_[of_[frame]].field; }
    // Returns true if the frame belongs to another run than the previous frame.
    bool changed(std::size_t frame) const { return frame > 0 && of_[frame] != of_[frame - 1]; }
    int threads() const { return runs_.front().field->threads(); }

    const std::vector<Vector>& places() const { return places_; }          // each frame's eye
    const std::vector<double>& clearances() const { return clearances_; }  // the estimate at each frame's eye
    std::vector<Passage> passages() const;                                 // distinct_passages()

    // Returns true if the camera meets no solid on its way from the previous frame to this one. The straight segment is
    // tested in the shapes of both frames. If the shapes differ, moments in between are tested as well, with position
    // and shape interpolated linearly.
    bool free_before(std::size_t frame) const;

    // Returns the difference of two estimates at the frame's eye, divided by the smaller of the two: one for the shape
    // of the previous frame, and one for the shape of this frame.
    double wall_step(std::size_t frame) const;

private:
    struct Moment {
        Scene scene;
        double clearance;
    };
    // Returns true if the estimate is above `floor` halfway between the moments and, by recursion, halfway in both
    // halves. The recursion ends when the estimate halfway is close to the mean of the estimates at the two ends, or
    // when it has reached the greatest depth.
    static bool free_between(const Moment& from, const Moment& to, double floor, int depth);

    const Path& path_;
    std::vector<Run> runs_;
    std::vector<std::size_t> of_;  // for each frame: its run's index
    std::vector<Vector> places_;
    std::vector<double> clearances_;
};

// approach: the frames before the first narrow place. passages: the frames from the first narrow place to the last one.
// out: the frames after the last narrow place.
enum class Chapter { approach, passages, out };
inline constexpr std::array<std::string_view, 3> chapter_names{"approach", "passages", "out"};

// A part of a flight.
struct Part {
    std::optional<Chapter> chapter;  // nullopt: the whole flight
    std::optional<double> from, to;  // seconds since the beginning of the chapter

    bool whole() const { return !chapter && !from && !to; }
};

// Returns the first and the last frame of a part that is not the whole flight. The narrow places are those that the
// audit counts as distinct passages. Throws InputError if the flight does not have the chapter or the seconds.
std::pair<std::size_t, std::size_t> frames_of(const Path& path, const Part& part, int threads);

}  // namespace mandelmarch
