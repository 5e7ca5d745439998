// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/director.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>

#include "flight/audit/views.h"
#include "flight/field/threads.h"
#include "flight/ride/gaze.h"

namespace mandelmarch {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr int directions = 1024;                 // of a panorama, about 6 degrees apart
constexpr double window = 42 * degree;           // radius of a view: mean of a picture's half width and half height
constexpr double middle_radius = 22 * degree;    // radius of the central part of a view
constexpr double panorama_spacing = 1;           // clearances from one panorama to the next
constexpr double coarse_share = 0.02;            // hit tolerance, as a fraction of the ray's length so far
constexpr std::size_t slot_frames = 10;          // the gaze is chosen for every tenth frame
constexpr double farthest_turn = 11.5 * degree;  // largest turn from one choice to the next
constexpr double most_aside = 50 * degree;       // angle between gaze and motion beyond which the cost rises steeply
constexpr double off_motion = 0.5;               // cost if the angle between gaze and motion is most_aside
constexpr double too_far_off = 20;               // additional cost if it is twice as large
constexpr double off_stop = 200;                 // cost if the angle between gaze and a stop's direction is most_aside
constexpr double around_stop = 45;  // frames before and after a stop in which the gaze has the direction of the stop
constexpr double turning = 0.6;     // cost of a turn by farthest_turn
constexpr double avoiding = 3;      // cost of an avoided direction
constexpr double avoided_angle = 25 * degree;  // angle to an avoided direction from which on there is no cost
constexpr std::size_t avoided_time = 45;       // frames before and after it in which a direction is avoided

// Thresholds for the contents of a view, tuned with ten seeds for each of two fractals.
constexpr double enough_hits = 0.75, few_hits = 0.3;     // fractions of the view that hit something
constexpr double enough_middle = 0.6;                    // fraction of the central part that hits something
constexpr double wall_distance = 2.2, much_wall = 0.65;  // walls are closer (clearances); a larger fraction costs
constexpr double enough_depths = 0.55;                   // standard deviation of the logarithms of the depths

const Sphere& sphere()
{
    static const Sphere made(directions, window);
    return made;
}

std::span<const float> of_panorama(const std::vector<float>& all, std::size_t panorama)
{
    return std::span(all).subspan(panorama * directions, directions);
}

double square(double x) { return x * x; }

// Returns, for each direction near the given one, whether it is in the central part of a view in this direction.
std::span<const char> middle(int direction)
{
    static const auto made = [] {
        const auto& all = sphere().directions();
        std::vector<std::vector<char>> flags(directions);
        for (std::size_t d = 0; d < directions; ++d) {
            for (const int k : sphere().near(static_cast<int>(d))) {
                flags[d].push_back(dot(all[d], all[static_cast<std::size_t>(k)]) > std::cos(middle_radius) ? 1 : 0);
            }
        }
        return flags;
    }();
    return made[static_cast<std::size_t>(direction)];
}

double angle_of_units(Vector a, Vector b) { return std::acos(std::clamp(dot(a, b), -1.0, 1.0)); }

// A turn of the gaze from the direction `from` to another one, with its cost. turns() returns, for each direction, all
// turns that end at it.
struct Turn {
    int from;
    double cost;
};
const std::vector<std::vector<Turn>>& turns()
{
    static const auto made = [] {
        std::vector<std::vector<Turn>> all(directions);
        for (std::size_t to = 0; to < directions; ++to) {
            for (const int from : sphere().near(static_cast<int>(to))) {
                const Vector& a = sphere().directions()[to];
                const Vector& b = sphere().directions()[static_cast<std::size_t>(from)];
                const double angle = angle_of_units(a, b);
                if (angle < farthest_turn) all[to].push_back({from, turning * square(angle / farthest_turn)});
            }
        }
        return all;
    }();
    return made;
}

// Returns the stop whose stay is less than around_stop frames from the frame, or null. If there are two, returns the
// closer one.
const Stop* stop_near(std::span<const Stop> stops, std::size_t frame)
{
    const auto at = static_cast<double>(frame);
    const auto away = [at](const Stop& stop) { return std::max({stop.arrives - at, at - stop.leaves, 0.0}); };
    const auto nearest = std::ranges::min_element(stops, {}, away);
    return nearest != stops.end() && away(*nearest) < around_stop ? &*nearest : nullptr;
}

// Returns a penalty that falls from 1 to 0 while `value` rises from `none` to `enough`.
double lack(double value, double enough, double none)
{
    return square(std::clamp((enough - value) / (enough - none), 0.0, 1.0));
}

}  // namespace

Sphere::Sphere(int count, double apart)
{
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2.0 * i + 1) / count;
        const double r = std::sqrt(1 - z * z);
        const double angle = 2 * std::numbers::pi * i / std::numbers::phi;
        directions_.push_back({r * std::cos(angle), r * std::sin(angle), z});
    }
    near_.resize(directions_.size());
    for (std::size_t i = 0; i < directions_.size(); ++i) {
        near_[i].push_back(static_cast<int>(i));
        for (std::size_t j = 0; j < directions_.size(); ++j) {
            if (i != j && dot(directions_[i], directions_[j]) > std::cos(apart))
                near_[i].push_back(static_cast<int>(j));
        }
    }
}

int Sphere::nearest(Vector unit_vector) const
{
    const auto closer = [&](Vector a, Vector b) { return dot(a, unit_vector) < dot(b, unit_vector); };
    return static_cast<int>(std::ranges::max_element(directions_, closer) - directions_.begin());
}

std::vector<float> panoramas(const Shapes& shapes, const Sphere& sphere, std::span<const Vector> places,
                             std::span<const double> values, double end)
{
    const std::size_t count = sphere.directions().size();
    std::vector<float> depths(places.size() * count);
    parallel(places.size(), 8, shapes.threads(), [&](std::size_t first, std::size_t last) {
        std::vector<Vector> from(count);
        std::vector<double> t(count);
        for (std::size_t i = first; i < last; ++i) {
            std::ranges::fill(from, places[i]);
            std::optional<DistanceField> room;
            shapes.at(values[i], room)
                .casts(from, sphere.directions(),
                       {.floor = 0, .tolerance = coarse_share, .end = end, .steps = most_steps}, t);
            std::ranges::transform(t, depths.begin() + static_cast<std::ptrdiff_t>(i * count), [end](double depth) {
                return depth < end ? static_cast<float>(depth) : std::numeric_limits<float>::infinity();
            });
        }
    });
    return depths;
}

Director::Director(const Shapes& shapes, const Curve& track) : threads_(shapes.threads())
{
    const DistanceField& field = shapes.field();
    std::vector<Vector> places;
    std::vector<double> values;
    std::vector<double> clearances;
    double next = 0;
    for (std::size_t s = 0; s < track.at.size(); ++s) {
        if (track.length[s] < next) continue;
        next = track.length[s] + panorama_spacing * std::min(track.clearance[s], fastest_clearance(field.bounds()));
        samples_.push_back(static_cast<double>(s));
        places.push_back(track.at[s]);
        values.push_back(track.value[s]);
        clearances.push_back(track.clearance[s]);
    }
    const double end = farthest_seen * field.bounds().size;
    depths_ = panoramas(shapes, sphere(), places, values, end);
    costs_.resize(depths_.size());
    parallel(places.size(), 8, field.threads(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            rate(of_panorama(depths_, i), clearances[i], std::span(costs_).subspan(i * directions, directions));
        }
    });
}

void Director::rate(std::span<const float> depths, double clearance, std::span<float> costs)
{
    // The terms of the sums below; all are 0 in a direction in which nothing is hit.
    struct Terms {
        double logarithm = 0, square = 0;
        int hit = 0, wall = 0;
    };
    std::vector<Terms> terms(depths.size());
    const double wall = std::log(wall_distance * clearance);
    std::ranges::transform(depths, terms.begin(), [wall](float d) {
        const double depth = std::log(static_cast<double>(d) + 1e-12);
        return std::isfinite(depth) ? Terms{depth, depth * depth, 1, depth < wall ? 1 : 0} : Terms{};
    });
    for (int d = 0; d < directions; ++d) {
        const auto near = sphere().near(d);
        const auto inner = middle(d);
        int hits = 0;
        int walls = 0;
        int middles = 0;
        int middle_hits = 0;
        double sum = 0;
        double squares = 0;
        for (std::size_t i = 0; i < near.size(); ++i) {
            const Terms& at = terms[static_cast<std::size_t>(near[i])];
            middles += inner[i];
            middle_hits += at.hit * inner[i];
            hits += at.hit;
            walls += at.wall;
            sum += at.logarithm;
            squares += at.square;
        }
        const auto count = static_cast<double>(near.size());
        const double every = std::max(hits, 1);
        const double mean = sum / every;
        const double spread = std::sqrt(std::max(squares / every - mean * mean, 0.0));
        const double cost = 2 * lack(hits / count, enough_hits, few_hits) +
                            lack(static_cast<double>(middle_hits) / middles, enough_middle, 0) +
                            1.5 * lack(-walls / count, -much_wall, -0.95) + 0.7 * lack(spread, enough_depths, 0);
        costs[static_cast<std::size_t>(d)] = static_cast<float>(cost);
    }
}

std::size_t Director::panorama_at(double sample) const
{
    const auto after = std::ranges::upper_bound(samples_, sample);
    auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - samples_.begin() - 1, 0));
    if (i + 1 < samples_.size() && samples_[i + 1] - sample < sample - samples_[i]) ++i;
    return i;
}

double Director::motion(double sample, const Frame& from, const Frame& to) const
{
    const auto depths = of_panorama(depths_, panorama_at(sample));
    const auto near = sphere().near(sphere().nearest(unit(from.target - from.eye)));
    std::vector<Vector> along;
    std::vector<float> hits;
    for (const int k : near) {
        const float depth = depths[static_cast<std::size_t>(k)];
        if (!std::isfinite(depth)) continue;
        along.push_back(sphere().directions()[static_cast<std::size_t>(k)]);
        hits.push_back(depth);
    }
    return median_motion(along, hits, from, to);
}

std::vector<double> Director::slot_costs(const Trajectory& ride, std::span<const std::size_t> frames,
                                         std::span<const Stop> stops, std::span<const Avoided> avoided) const
{
    std::vector<double> all(frames.size() * directions);
    parallel(frames.size(), 16, threads_, [&](std::size_t first, std::size_t last) {
        for (std::size_t slot = first; slot < last; ++slot) {
            const Vector soon = ahead(ride, frames[slot], look_ahead);
            const Vector motion = ahead(ride, frames[slot], 1);
            const auto costs = of_panorama(costs_, panorama_at(ride.sample[frames[slot]]));
            const Stop* const stop = stop_near(stops, frames[slot]);
            for (std::size_t n = 0; n < directions; ++n) {
                const Vector& direction = sphere().directions()[n];
                const double off = angle_of_units(direction, motion);
                all[slot * directions + n] =
                    stop != nullptr ? off_stop * square(angle_of_units(direction, stop->along) / most_aside)
                                    : static_cast<double>(costs[n]) +
                                          off_motion * square(angle_of_units(direction, soon) / most_aside) +
                                          too_far_off * std::max(0.0, off / most_aside - 1);
            }
            if (stop != nullptr) continue;
            std::vector<Avoided> near;
            std::ranges::copy_if(avoided, std::back_inserter(near), [&](const Avoided& view) {
                return view.frame <= frames[slot] + avoided_time && frames[slot] <= view.frame + avoided_time;
            });
            for (std::size_t n = 0; n < directions && !near.empty(); ++n) {
                double closest = avoided_angle;
                for (const Avoided& view : near) {
                    closest = std::min(closest, angle_of_units(sphere().directions()[n], view.direction));
                }
                all[slot * directions + n] += avoiding * lack(closest, avoided_angle, 0);
            }
        }
    });
    return all;
}

std::vector<Vector> Director::gaze(const Trajectory& ride, int frames, std::span<const Stop> stops,
                                   std::span<const Avoided> avoided) const
{
    // Slots are the frames for which the gaze is chosen: every tenth frame, and the last frame.
    const std::size_t slots = (static_cast<std::size_t>(frames) + slot_frames - 2) / slot_frames + 1;
    std::vector<std::size_t> slot_at(slots);  // the frame of each slot
    for (std::size_t slot = 0; slot < slots; ++slot)
        slot_at[slot] = std::min(slot * slot_frames, static_cast<std::size_t>(frames) - 1);
    const std::vector<double> costs = slot_costs(ride, slot_at, stops, avoided);
    std::vector<double> best(costs.begin(), costs.begin() + directions);
    std::vector<std::vector<int>> before(slots, std::vector<int>(directions, -1));
    for (std::size_t slot = 1; slot < slots; ++slot) {
        std::vector<double> now(directions);
        for (std::size_t n = 0; n < directions; ++n) {
            double least = std::numeric_limits<double>::infinity();
            int from = -1;
            for (const Turn& turn : turns()[n]) {
                const double sum = best[static_cast<std::size_t>(turn.from)] + turn.cost;
                from = sum < least ? turn.from : from;
                least = std::min(least, sum);
            }
            now[n] = least + costs[slot * directions + n];
            before[slot][n] = from;
        }
        best = std::move(now);
    }
    std::vector<Vector> chosen(slots);
    int at = static_cast<int>(std::ranges::min_element(best) - best.begin());
    for (std::size_t slot = slots; slot-- > 0;) {
        chosen[slot] = sphere().directions()[static_cast<std::size_t>(at)];
        at = before[slot][static_cast<std::size_t>(at)];
    }
    std::vector<Vector> aims;
    for (std::size_t i = 0; i < static_cast<std::size_t>(frames); ++i) {
        const std::size_t slot = std::min(i / slot_frames, slots - 2);
        const double share =
            static_cast<double>(i - slot_at[slot]) / static_cast<double>(slot_at[slot + 1] - slot_at[slot]);
        const Stop* const stop = stop_near(stops, i);
        aims.push_back(stop != nullptr ? stop->along : unit((1 - share) * chosen[slot] + share * chosen[slot + 1]));
    }
    return aims;
}

}  // namespace mandelmarch
