// SPDX-License-Identifier: Apache-2.0
#include "flight/ride/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/os/stopwatch.h"
#include "core/scene/fractal.h"
#include "core/text/error.h"
#include "flight/audit/audit.h"
#include "flight/path/measures.h"
#include "flight/ride/director.h"
#include "flight/ride/gaze.h"
#include "flight/ride/pacing.h"
#include "flight/ride/trajectory.h"
#include "flight/ride/visits.h"
#include "flight/route/elastic_band.h"
#include "flight/route/roadmap.h"

namespace mandelmarch {
namespace {

constexpr double least_clearance = 0.0034;  // fractal sizes; the elastic band's smallest clearance
constexpr double field_of_view = 1.0;
constexpr double turn_limit = 1.17;  // degrees per frame; turns are limited to this, because the promise is 1.2
constexpr int retimings = 7;         // number of times that speed and gaze are adapted to each other
// For shapes that change in flight:
constexpr double first_share = 0.6;  // initial guess of the mean speed, as a fraction of the pace
constexpr double usual_slow = 0.7;   // wanted mean of a tour's speed factors
constexpr double most_off = 1;       // frames; largest accepted time error at a keyframe

// Limit on a plan's processor time: usual_seconds, or changing_seconds for the roadmaps of many shapes, plus
// seconds_a_frame for each frame. The limit is many times what the official shapes need.
constexpr double usual_seconds = 60, changing_seconds = 300;
constexpr double seconds_a_frame = 0.02;

constexpr int audit_stride = 5;  // frames between the views that audits of tours examine

class Planner {
public:
    Planner(const PlanOptions& options, const Budget& budget, const std::function<void(int, int)>& begins)
        : schedule_(options.schedule),
          places_(options.places),
          shapes_(options.scene, options.schedule.number(), options.threads, &budget),
          measures_(flight_measures(*options.scene.fractal)),
          seed_(options.seed),
          frames_(options.frames),
          size_(shapes_.field().bounds().size),
          atlas_(shapes_, schedule_, begins)
    {
    }

    const RoadmapSet& atlas() const { return atlas_; }

    // Finds the places in the free space. Called before attempt(). Throws InputError as visits_of() does.
    void find_places() { visits_ = visits_of(places_, atlas_.stretches(frames_).front(), least_clearance * size_); }

    // Returns a message about the place that the last tour missed; "" if it missed none.
    const std::string& missed() const { return missed_; }

    // Plans tour number `number` and returns its path. The path is empty if the tour is too short, if the camera misses
    // a place or, if the shape changes, if the camera cannot keep to the schedule.
    Path attempt(int number)
    {
        missed_.clear();
        FlightRandom random(seed_ * 0x100 + static_cast<std::uint64_t>(number) + 1);
        for (int i = 0; i < 4; ++i) random.next();
        TourLength length;
        if (schedule_.changes()) {
            length.frames_a_clearance = 1 / (measures_.pace * share_);
            length.clock = frames_ + 4 * look_ahead;
        } else {
            // After the last place, a tour of one gate is long enough.
            length.cost = visits_.empty() || places_.tour_after ? 1.2 * measures_.pace * frames_ + 60 : 0;
        }
        give_gates(visits_, places_, measures_.pace * share_);
        const std::function<bool(const Polyline&)> fine = [this](const Polyline& part) {
            return least_on(shapes_, part, schedule_, atlas_.step()) > least_clearance * size_;
        };
        const Tour tour = make_tour(atlas_.stretches(frames_), length, random,
                                    schedule_.changes() ? fine : std::function<bool(const Polyline&)>{}, visits_);
        if (schedule_.changes() && tour.clock < length.clock) return {};
        flown_.emplace(shapes_, track_of(shapes_, schedule_,
                                         smooth(shapes_, tour.way, schedule_, atlas_.step(), least_clearance * size_)));
        avoided_.clear();
        const std::vector<Vector> views = fly(*flown_);
        return views.empty() ? Path{} : path_of(*flown_, views);
    }

    // Returns the path of the last attempt with another gaze: the camera looks elsewhere in the given frames of the
    // path. Returns an empty path if the camera then misses a place.
    Path look_elsewhere(const Path& path, std::span<const std::size_t> frames)
    {
        for (const std::size_t frame : frames) {
            avoided_.push_back({frame, unit(path.frames[frame].target - path.frames[frame].eye)});
        }
        return path_of(*flown_, gaze(*flown_, static_cast<int>(path.frames.size())));
    }

private:
    // A flight along a curve.
    struct Flown {
        Flown(const Shapes& shapes, Curve curve) : track(std::move(curve)), director(shapes, track) {}

        Curve track;
        Director director;
        std::vector<Stop> stops = {};
        Trajectory ride = {};
    };

    // Returns the smoothed gaze in the first `frames` frames of a flight.
    std::vector<Vector> gaze(const Flown& flown, int frames) const
    {
        std::vector<Vector> views =
            smoothed_gaze(flown.ride, flown.director.gaze(flown.ride, frames, flown.stops, avoided_),
                          visits_.empty() || !visits_.front().starts);
        hold_gaze(views, flown.stops);
        return views;
    }

    // Adapts the speed and the gaze of a flight to each other. Returns the gaze, or nothing in the same cases as
    // attempt().
    std::vector<Vector> fly(Flown& flown)
    {
        const int needed = frames_ + look_ahead;
        Curve& track = flown.track;
        const Bounds& bounds = shapes_.field().bounds();
        flown.stops = stops_of(bounds, track, places_, visits_);
        std::vector<Stop>& stops = flown.stops;
        std::vector<Vector> views;
        Trajectory& now = flown.ride;
        double off = 0;
        int skip = 0;  // frames of the approach that are left out
        for (int round = 0; round < retimings; ++round) {
            if (schedule_.changes()) {
                Timed timed = ride_in_time(bounds, track, measures_.pace, frames_, schedule_);
                now = std::move(timed.ride);
                off = timed.off;
            } else if (!stops.empty()) {
                now = ride_to_stops(bounds, track, measures_.pace, frames_, stops).ride;
            } else {
                now = ride_without(bounds, track, measures_.pace, needed, skip);
            }
            // If the trajectory has too few frames in the first rounds, it may have enough in later ones, which slow
            // the camera down in bends.
            const int wanted = frames_until(stops);
            const int frames = std::min(wanted, static_cast<int>(now.at.size()));
            if (frames < wanted / 4 || (frames < wanted && round > 2)) return {};
            const bool last = round + 1 == retimings;
            if (last && !schedule_.changes() && stops.empty()) ease_ends(now, frames);
            views = gaze(flown, frames);
            if (last) break;
            if (!schedule_.changes() && stops.empty()) skip = shortened_by(bounds, now, frames, skip);
            keep_moving(track, now, cameras(now, views, first_up(views[0]), field_of_view), flown.director);
            slow_turns(track, now, views);
        }
        if (schedule_.changes() || !stops.empty()) learn(track, now);
        if (off > most_off) return {};
        return views;
    }

    // Returns the path of a flight with this gaze, or an empty path if the camera misses a place.
    Path path_of(const Flown& flown, std::vector<Vector> views)
    {
        limit_turns(views, turn_limit);
        if (missed_ = missed_stop(places_, flown.stops, views); !missed_.empty()) return {};
        Path path;
        path.scene = shapes_.field().scene();
        path.seed = seed_;
        path.frames = cameras(flown.ride, views, first_up(views[0]), field_of_view);
        hold_level(path.frames, *path.scene.fractal, hold_lens(path.frames, flown.stops));
        if (schedule_.changes()) change(path, flown.track, flown.ride);
        cut_digits(path);
        return path;
    }

    // Returns the number of frames of a flight with these stops.
    int frames_until(const std::vector<Stop>& stops) const
    {
        if (stops.empty() || places_.tour_after) return frames_;
        return std::clamp(static_cast<int>(std::ceil(stops.back().leaves)) + 1, 2, frames_);
    }

    // Updates share_, with which the next tour's shape time is computed, from the mean speed factor of this trajectory.
    void learn(const Curve& track, const Trajectory& ride)
    {
        double sum = 0;
        for (const double sample : ride.sample) sum += track.slow[static_cast<std::size_t>(sample)];
        const double mean = sum / static_cast<double>(ride.sample.size());
        share_ = std::clamp(share_ * std::pow(usual_slow / mean, 0.7), 0.2, 1.0);
    }

    // Sets each frame's shape. The shape parameter is rounded to single precision, as in path files.
    void change(Path& path, const Curve& track, const Trajectory& ride) const
    {
        const std::vector<double> clock = clock_of(track, ride, static_cast<int>(path.frames.size()), schedule_);
        for (std::size_t i = 0; i < path.frames.size(); ++i) {
            const auto shape = shapes_.scene(static_cast<float>(schedule_.value(clock[i]))).shape;
            if (shape != path.scene.shape) path.frames[i].changes.shape = shape;
        }
    }

    const Schedule& schedule_;
    const Places& places_;
    Shapes shapes_;
    FlightMeasures measures_;
    std::uint64_t seed_;
    int frames_;
    double size_;
    RoadmapSet atlas_;
    std::vector<Visit> visits_;
    std::string missed_;
    std::optional<Flown> flown_;    // the last attempt's flight
    std::vector<Avoided> avoided_;  // its views that are not to be repeated
    double share_ = first_share;    // expected mean speed of the next tour, as a fraction of the pace
};

}  // namespace

Plan plan(PlanOptions options)
{
    const auto start = Clock::now();
    const auto seconds = [&] { return seconds_since(start); };
    const auto say = [&](const std::string& text) {
        if (options.log) options.log(fmt::format("{:5.1f} s  {}", seconds(), text));
    };
    const auto& [scene, schedule, seed, frames, threads, log, most_seconds, places] = options;
    if (!schedule.knots().empty()) options.scene.shape[schedule.number()] = schedule.value(0);
    if (const std::string objection = flight_objection(scene); !objection.empty()) throw InputError(objection);
    const bool changes = schedule.changes();
    const double usual = (changes ? changing_seconds : usual_seconds) + seconds_a_frame * frames;
    const Budget budget(most_seconds > 0 ? most_seconds : usual,
                        changes ? "a smaller change, more frames, fewer iterations or another seed"
                                : "fewer iterations, fewer frames or another shape (another seed does not help)");
    if (changes && !places.all.empty()) {
        throw InputError(fmt::format("{}: the shape changes in flight, expected a constant shape", places.file));
    }
    if (!places.all.empty()) {
        const DistanceField field(scene, threads, &budget);
        check_places(places, field, least_clearance * field.bounds().size, frames);
    }
    Planner planner(options, budget, [&](int number, int all) { say(fmt::format("roadmap {} of {}", number, all)); });
    say(fmt::format("{} balls, {} gates{}", planner.atlas().balls().size(), planner.atlas().gates().size(),
                    planner.atlas().shapes() > 1 ? fmt::format(" of {} shapes", planner.atlas().shapes()) : ""));
    planner.atlas().check(scene);
    planner.find_places();
    constexpr int most_attempts = 24;
    constexpr int usual_attempts = 12;
    constexpr int most_gazes = 5;              // flights audited for each tour
    constexpr std::size_t most_repeated = 16;  // views; with more, the gaze is not chosen again
    constexpr int most_missed = 6;             // tours that miss a place, if no tour has visited all places
    Path best;                                 // empty: no tour so far is long enough and passes all places
    double faults = 1e300;                     // of the best flight
    std::string broken;                        // its broken promises
    std::string missed;                        // message of the tour before
    std::vector<bool> kept;                    // the items that the tour before keeps
    bool settled = false;  // the tour before keeps the same items, so the places decide what is missed
    int attempts = 0;
    for (int number = 0; number < most_attempts; ++number) {
        budget.check();
        Path path = planner.attempt(number);
        ++attempts;
        if (path.frames.empty()) {
            say(planner.missed().empty()
                    ? fmt::format("tour {}: too short{}", number, schedule.changes() ? ", or not in time" : "")
                    : fmt::format("tour {}: {}", number, planner.missed()));
            // The same message twice means that the tours' random choices change nothing.
            const bool again = planner.missed() == missed || number + 1 >= most_missed;
            if (!planner.missed().empty() && best.frames.empty() && again) break;
            missed = planner.missed();
            continue;
        }
        // If only views repeat, the gaze is chosen again.
        for (int gaze = 0; gaze < most_gazes && !path.frames.empty(); ++gaze) {
            budget.check();
            const Audit result = audit(path, threads, audit_stride);
            say(fmt::format("tour {}{}: misses {}\n{}", number, gaze > 0 ? ", looking elsewhere" : "",
                            result.missed(false), table_of(path, result)));
            if (gaze == 0 && !places.all.empty()) {
                std::vector<bool> now;
                for (const Row& row : result.rows) now.push_back(row.kept());
                settled = now == std::exchange(kept, now);
            }
            const bool mendable =
                result.bars_missed() == 1 && !result.repeated.empty() && result.repeated.size() <= most_repeated;
            Path next = mendable && gaze + 1 < most_gazes ? planner.look_elsewhere(path, result.repeated) : Path{};
            if (result.faults() < faults) {
                faults = result.faults();
                broken = result.missed(true);
                best = std::move(path);
            }
            path = std::move(next);
        }
        if (faults == 0 || ((settled || number + 1 >= usual_attempts) && faults < broken_promise)) break;
    }
    std::vector<Ball> gates = planner.atlas().gates();
    if (best.frames.empty()) {
        if (!planner.missed().empty()) throw InputError(planner.missed());
        throw Error(fmt::format(
            "plan: no tour of seed {} is {} for {} frames among {} gates, expected {} frames, another seed or {}", seed,
            changes ? "in time" : "long enough", frames, gates.size(), changes ? "more" : "fewer",
            changes ? "a smaller change" : "a shape with more gates"));
    }
    if (faults >= broken_promise) {
        throw Error(
            fmt::format("plan: no tour of seed {} among {} gates keeps every promise, the best breaks: {}; "
                        "expected another seed or a shape with more gates",
                        seed, gates.size(), broken));
    }
    return {std::move(best), seconds(), attempts, planner.atlas().balls(), std::move(gates)};
}

}  // namespace mandelmarch
