// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/stopwatch.h"
#include "core/scene/fractal.h"
#include "flight/audit/audit.h"
#include "flight/audit/passages.h"
#include "flight/plan/band.h"
#include "flight/plan/director.h"
#include "flight/plan/gaze.h"
#include "flight/plan/ride.h"

namespace mandelmarch {
namespace {

constexpr double least_clearance = 0.0034;  // hull sizes: the band goes nowhere nearer to a surface
constexpr int tries = 300'000;              // places where gates are looked for
constexpr double field_of_view = 1.0;
constexpr double wanted_turn = 0.95;    // degrees a frame: where the gaze turns faster, the ride slows down
constexpr double turn_limit = 1.17;     // degrees a frame; the promise is 1.2
constexpr double slowest = 0.08;        // of the pace
constexpr double usual_motion = 0.014;  // picture heights a frame at the median pixel: the ride keeps near it
constexpr int retimings = 7;
constexpr int audit_stride = 5;  // the same while tours are compared
constexpr int view_stride = 10;  // frames between the views whose motion is looked at

class Planner {
public:
    Planner(const Scene& scene, std::uint64_t seed, int frames, int threads)
        : field_(scene, threads),
          measures_(scene.fractal->flight.measures),
          seed_(seed),
          frames_(frames),
          size_(field_.hull().size),
          balls_(field_, measures_.roads * size_, 0.0022 * size_),
          gates_(find_gates(field_, balls_, measures_.gate_least * size_, measures_.gate_most * size_, tries))
    {
    }

    const std::vector<Ball>& balls() const { return balls_.balls(); }
    std::vector<Ball> gates() const
    {
        std::vector<Ball> narrowest;
        for (const Gate& gate : gates_) narrowest.push_back({gate.centre, gate.clearance});
        return narrowest;
    }

    // The path of one tour; empty if the tour was too short.
    Path attempt(int number)
    {
        Random random(seed_ * 0x100 + static_cast<std::uint64_t>(number) + 1);
        for (int i = 0; i < 4; ++i) random.next();
        const double budget = 1.2 * measures_.pace * frames_ + 60;
        const Tour tour = make_tour(field_, balls_, gates_, budget, random);
        const auto points = smooth(field_, tour.way, least_clearance * size_);
        Track track = track_of(field_, points);
        return fly(track);
    }

    const Field& field() const { return field_; }

private:
    Path fly(Track& track)
    {
        const int needed = frames_ + look_ahead;
        const Director director(field_, track);
        std::vector<Vector> views;
        Ride now;
        for (int round = 0; round < retimings; ++round) {
            now = ride(field_, track, measures_.pace, needed);
            // A ride that is too short now may last when it has slowed down in its bends.
            const int flown = std::min(frames_, static_cast<int>(now.at.size()));
            if (flown < frames_ / 4 || (flown < frames_ && round > 2)) return {};
            views = smoothed_gaze(now, director.gaze(now, flown));
            if (round + 1 == retimings) break;
            keep_moving(track, now, views, director);
            slow_turns(track, now, views);
        }
        limit_turns(views, turn_limit);
        Path path;
        path.scene = field_.scene();
        path.seed = seed_;
        path.frames = cameras(now, views, first_up(views[0]), field_of_view);
        cut_digits(path);
        return path;
    }

    // Where the gaze turns too fast, the track's samples become slow.
    void slow_turns(Track& track, const Ride& ride, const std::vector<Vector>& views) const
    {
        std::vector<double> factor(track.slow.size(), 1);
        for (std::size_t i = 1; i < views.size(); ++i) {
            const double turn = degrees_between(views[i - 1], views[i]);
            if (turn <= wanted_turn) continue;
            const auto first = static_cast<std::size_t>(ride.sample[i - 1]);
            const auto last = static_cast<std::size_t>(ride.sample[i]) + 1;
            for (std::size_t s = first; s <= std::min(last, factor.size() - 1); ++s) {
                factor[s] = std::min(factor[s], std::pow(wanted_turn / turn, 1.2));
            }
        }
        for (std::size_t s = 0; s < factor.size(); ++s) track.slow[s] = std::max(slowest, track.slow[s] * factor[s]);
    }

    // Where the picture moves faster than usual the ride slows down, where slower it goes faster, as far as the pace
    // allows.
    void keep_moving(Track& track, const Ride& ride, const std::vector<Vector>& views, const Director& director) const
    {
        const auto frames = cameras(ride, views, first_up(views[0]), field_of_view);
        for (std::size_t i = 0; i + 1 < frames.size(); i += view_stride) {
            const double motion = director.motion(ride.sample[i], frames[i], frames[i + 1]);
            const double wanted = std::clamp(std::pow(usual_motion / std::max(motion, 1e-5), 0.8), 0.4, 2.0);
            const std::size_t end = std::min(i + view_stride, ride.sample.size() - 1);
            for (auto s = static_cast<std::size_t>(ride.sample[i]); s < static_cast<std::size_t>(ride.sample[end]); ++s)
                track.slow[s] = std::clamp(track.slow[s] * wanted, slowest, 1.0);
        }
    }

    // The up vector of the first camera: y, or z where the gaze goes along y.
    static Vector first_up(Vector view) { return std::abs(view.y) < 0.7 ? Vector{0, 1, 0} : Vector{0, 0, 1}; }

    Field field_;
    FlightMeasures measures_;
    std::uint64_t seed_;
    int frames_;
    double size_;
    Balls balls_;
    std::vector<Gate> gates_;
};

// Bars missed, and by how much: a promise weighs more than all quality.
double faults(const Audit& audit)
{
    double sum = 0;
    for (const Row& row : audit.rows) {
        if (row.kept()) continue;
        const double by = std::abs(row.value - row.bar) / std::max(std::abs(row.bar), 1.0);
        sum += (row.promise ? 1000 : 1) * (1 + std::min(by, 5.0));
    }
    return sum;
}

}  // namespace

Plan plan(const Scene& scene, std::uint64_t seed, int frames, int threads, const Log& log)
{
    const auto start = Clock::now();
    const auto seconds = [&] { return seconds_since(start); };
    const auto say = [&](const std::string& text) {
        if (log) log(fmt::format("{:5.1f} s  {}", seconds(), text));
    };
    Planner planner(scene, seed, frames, threads);
    say(fmt::format("{} balls, {} gates", planner.balls().size(), planner.gates().size()));
    constexpr int most_attempts = 24;
    constexpr int usual_attempts = 12;
    Plan best;
    double least = 1e300;
    for (int number = 0; number < most_attempts; ++number) {
        Path path = planner.attempt(number);
        ++best.attempts;
        if (path.frames.empty()) {
            say(fmt::format("tour {}: too short", number));
            continue;
        }
        const Audit result = audit(path, threads, 0, audit_stride);
        const double here = faults(result);
        say(fmt::format("tour {}: {} bars missed, {:.2f}\n{}", number, result.bars_missed(), here,
                        table_of(path, result)));
        if (here < least) {
            least = here;
            best.path = std::move(path);
        }
        if (least == 0 || (number + 1 >= usual_attempts && least < 1000)) break;
    }
    best.seconds = seconds();
    best.balls = planner.balls();
    best.gates = planner.gates();
    if (least >= 1000) throw Error(fmt::format("plan: no tour of seed {} keeps every promise", seed));
    return best;
}

}  // namespace mandelmarch
