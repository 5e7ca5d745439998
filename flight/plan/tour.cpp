// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/tour.h"

#include <algorithm>
#include <cmath>

#include "flight/plan/search.h"

namespace mandelmarch {
namespace {

constexpr double start_distance = 2.5;  // fractal sizes; distance of the tour's first point from the centre
constexpr int most_refused = 60;        // number of discarded parts that ends a tour; a Search::stroll() counts as five
constexpr double dear_gate = 130;       // clearances with penalties; a stroll is preferred to a gate farther away

class Guide {
public:
    Guide(std::span<const RoadmapSpan> stretches, const TourLength& length, FlightRandom& random,
          const std::function<bool(const Polyline& part)>& fine)
        : search_(stretches, length.frames_a_clearance), length_(length), random_(random), fine_(fine)
    {
    }

    Tour fly()
    {
        Node at{0, start()};
        const Vector first = search_.ball(at).centre;
        const Vector eye = start_distance * search_.field(0).bounds().size * unit(first);
        add(eye, false, 0);
        add(first, false, 0);
        int refused = 0;
        while (tour_.cost < length_.cost && tour_.clock < length_.clock) {
            Entry entry = search_.next(at, tour_.clock, tour_.way.points, random_);
            if (entry.number < 0) {
                // If all gates in reach are of kinds that are marked as flown, they are allowed again.
                search_.forget();
                entry = search_.next(at, tour_.clock, tour_.way.points, random_);
            }
            const Tour before = tour_;
            const bool strolls = std::isfinite(length_.clock) && search_.stroll().ball >= 0 &&
                                 (entry.number < 0 || search_.cost(ball_before(entry)) > dear_gate);
            if (entry.number < 0 && !strolls) break;
            Node to = search_.stroll();
            if (strolls) {
                fly_to(to);
            } else {
                to = pass(entry);
            }
            if (moved_on(to) && (!fine_ || fine_(part_from(before.way.points.size())))) {
                at = to;
            } else {
                // The part is discarded, because the next roadmap has no ball near the end of the part or because walls
                // close around the part. The gate in it stays marked as flown, so that this gate is not tried again.
                tour_ = before;
                if ((refused += strolls ? 5 : 1) > most_refused) break;
            }
        }
        return std::move(tour_);
    }

private:
    Node ball_before(Entry entry) const
    {
        return {entry.stretch, search_.gate(entry).balls[static_cast<std::size_t>(entry.number) % 2]};
    }

    // Returns a large ball outside the bounds, chosen at random.
    int start()
    {
        const Balls& balls = search_.roads(0).balls;
        std::vector<int> candidates;
        for (std::size_t i = 0; i < balls.balls().size(); ++i) {
            const Ball& ball = balls.balls()[i];
            if (ball.clearance > 0.1 * search_.field(0).bounds().size &&
                !search_.field(0).bounds().contains(ball.centre) && !balls.links(static_cast<int>(i)).empty()) {
                candidates.push_back(static_cast<int>(i));
            }
        }
        if (candidates.empty()) return 0;
        return candidates[static_cast<std::size_t>(random_.share() * static_cast<double>(candidates.size()))];
    }

    // Moves `at` from stretch to stretch, each time to a ball near the same place, until it is in the stretch that
    // contains the tour's shape time. Returns false if the roadmap of one of these stretches has no ball near the
    // place.
    bool moved_on(Node& at) const
    {
        while (tour_.clock > search_.stretch(at.stretch).until) {
            const Node to = search_.near(at.stretch + 1, search_.ball(at).centre);
            if (to.ball < 0) return false;
            at = to;
        }
        return true;
    }

    // Appends to the tour the leg that ends at `node`.
    void fly_to(Node node)
    {
        for (const Node at : search_.leg_to(node)) {
            search_.see(at);
            tour_.clock = search_.clock(at);
            add(search_.ball(at).centre, false, at.stretch);
        }
        tour_.cost += search_.cost(node);
    }

    // Extends the tour by a leg to the gate's entry and by the way through the gate. Returns the ball on the other
    // side.
    Node pass(Entry entry)
    {
        const Gate& through = search_.gate(entry);
        const std::size_t side = static_cast<std::size_t>(entry.number) % 2;
        const Node to = ball_before(entry);
        tour_.cost += search_.turn_cost(to, entry, tour_.way.points);
        fly_to(to);
        const auto& in = through.ways[side];
        const auto& out = through.ways[1 - side];
        const double step = 0.5 * length_.frames_a_clearance;
        const auto go = [&](Vector p, bool pin) {
            tour_.clock += step;
            add(p, pin, entry.stretch);
        };
        for (auto p = in.rbegin(); p + 1 != in.rend(); ++p) go(*p, false);
        go(through.centre, true);
        for (std::size_t i = 1; i < out.size(); ++i) go(out[i], false);
        tour_.cost += 0.5 * static_cast<double>(in.size() + out.size());
        search_.mark_flown(entry);
        ++tour_.gates;
        return {entry.stretch, through.balls[1 - side]};
    }

    // Returns the part of the polyline that begins with the point number `point`, preceded by up to four older points.
    Polyline part_from(std::size_t point) const
    {
        const auto first = static_cast<std::ptrdiff_t>(point - std::min<std::size_t>(point, 4));
        const auto cut = [first](const auto& all) {
            return std::decay_t<decltype(all)>(all.begin() + first, all.end());
        };
        const Polyline& way = tour_.way;
        return {cut(way.points), cut(way.pinned), cut(way.clock), cut(way.found)};
    }

    void add(Vector p, bool pin, int stretch)
    {
        Polyline& way = tour_.way;
        if (!way.points.empty() && length(way.points.back() - p) < 1e-9) return;
        way.points.push_back(p);
        way.pinned.push_back(pin ? 1 : 0);
        way.clock.push_back(tour_.clock);
        way.found.push_back(search_.stretch(stretch).value);
    }

    Search search_;
    TourLength length_;
    FlightRandom& random_;
    const std::function<bool(const Polyline& part)>& fine_;
    Tour tour_;
};

}  // namespace

Tour make_tour(std::span<const RoadmapSpan> stretches, const TourLength& length, FlightRandom& random,
               const std::function<bool(const Polyline& part)>& fine)
{
    return Guide(stretches, length, random, fine).fly();
}

}  // namespace mandelmarch
