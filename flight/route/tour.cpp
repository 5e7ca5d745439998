// SPDX-License-Identifier: Apache-2.0
#include "flight/route/tour.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flight/route/search.h"

namespace mandelmarch {
namespace {

constexpr double start_distance = 3;  // fractal sizes; distance of the tour's first point from the centre
constexpr double start_length = 0.3;  // fractal sizes; length of the tour's first part if the shape changes
// Fractal sizes; least clearance of the ball to which the tour leads first. The second applies if the first leaves
// fewer than few_starts balls.
constexpr std::array start_clearances{0.1, 0.06};
constexpr std::size_t few_starts = 8;
constexpr int most_refused = 60;   // number of discarded parts that ends a tour; a Search::stroll() counts as five
constexpr int most_detours = 5;    // number of gates left out on the way to a place after which none is tried
constexpr double dear_gate = 130;  // clearances with penalties; a stroll is preferred to a gate farther away

class Guide {
public:
    Guide(std::span<const RoadmapSpan> stretches, const TourLength& length, FlightRandom& random,
          const std::function<bool(const Polyline& part)>& fine, std::span<const Visit> visits)
        : search_(stretches, length.frames_a_clearance), length_(length), random_(random), fine_(fine), visits_(visits)
    {
    }

    Tour fly()
    {
        Node at{0, start()};
        if (visits_.empty() || !visits_.front().starts) {
            const Vector first = search_.ball(at).centre;
            const double size = search_.field(0).bounds().size;
            const bool changes = length_.frames_a_clearance > 0;
            add((changes ? length(first) + start_length * size : start_distance * size) * unit(first), Pin::none, 0);
            tour_.clock =
                length_.frames_a_clearance * start_length * size / fastest_clearance(search_.field(0).bounds());
            add(first, Pin::none, 0);
        }
        for (const Visit& visit : visits_) at = fly_by(at, visit);
        // The penalties of the ways to places do not shorten the tour that follows.
        const double most_cost =
            visits_.empty() ? length_.cost : tour_.cost + std::max(length_.cost - tour_.flown, 1.0);
        int refused = 0;
        while (tour_.cost < most_cost && tour_.clock < length_.clock) {
            const Entry entry = next(at);
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
            if (moved_on(to) && (!fine_ || fine_(part_from(before.way.size())))) {
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

    Entry next(Node at)
    {
        const Entry entry = search_.next(at, tour_.clock, heading(), random_);
        if (entry.number >= 0) return entry;
        // If all gates in reach are of kinds that are marked as flown, they are allowed again.
        search_.forget();
        return search_.next(at, tour_.clock, heading(), random_);
    }

    // Leads the tour to a place, and first through the visit's gates. Returns the visit's ball.
    Node fly_by(Node at, const Visit& visit)
    {
        const Node goal{0, visit.ball};
        if (!visit.starts) {
            const double flown = tour_.flown;
            for (int passed = 0, refused = 0; passed < visit.gates && refused < most_detours;) {
                const Entry entry = next(at);
                if (entry.number < 0) break;
                const Tour before = tour_;
                const Node to = pass(entry);
                if (search_.find(to, goal) && tour_.flown + flown_on(search_.leg_to(goal)) - flown < visit.longest) {
                    at = to;
                    ++passed;
                } else {
                    tour_ = before;
                    ++refused;
                }
            }
            if (search_.find(at, goal)) fly_to(goal);
        }
        const Vector begin = visit.place - visit.before * visit.along;
        // The way need not lead through the ball's centre.
        Polyline& way = tour_.way;
        if (way.size() > 1 && way.back().pin == Pin::none && search_.is_free(0, way[way.size() - 2].at, begin)) {
            way.pop_back();
        }
        add(begin, Pin::beside, 0);
        add(visit.place, Pin::place, 0);
        add(visit.place + visit.after * visit.along, Pin::beside, 0);
        return goal;
    }

    // Returns the length in clearances of the way through these balls, without penalties.
    double flown_on(const std::vector<Node>& leg) const
    {
        double sum = 0;
        for (std::size_t i = 1; i < leg.size(); ++i) {
            const Ball& from = search_.ball(leg[i - 1]);
            const Ball& to = search_.ball(leg[i]);
            sum += length(to.centre - from.centre) /
                   std::min(0.5 * (from.clearance + to.clearance), fastest_clearance(search_.field(0).bounds()));
        }
        return sum;
    }

    // Returns a large ball outside the bounds, chosen at random. If the tour leads straight to a place, the ball is, if
    // possible, on the place's side of the fractal.
    int start()
    {
        const Balls& balls = search_.roads(0).balls;
        std::vector<int> candidates;
        for (const double least : start_clearances) {
            candidates.clear();
            for (std::size_t i = 0; i < balls.balls().size(); ++i) {
                const Ball& ball = balls.balls()[i];
                if (ball.clearance > least * search_.field(0).bounds().size &&
                    !search_.field(0).bounds().contains(ball.centre) && !balls.links(static_cast<int>(i)).empty()) {
                    candidates.push_back(static_cast<int>(i));
                }
            }
            if (candidates.size() >= few_starts) break;
        }
        if (!visits_.empty() && visits_.front().gates == 0) {
            const auto behind = [&](int number) {
                const Vector centre = balls.balls()[static_cast<std::size_t>(number)].centre;
                return dot(centre, visits_.front().place) < 0.5 * length(centre) * length(visits_.front().place);
            };
            if (!std::ranges::all_of(candidates, behind)) std::erase_if(candidates, behind);
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
        const std::vector<Node> leg = search_.leg_to(node);
        for (const Node at : leg) {
            search_.see(at);
            tour_.clock = search_.clock(at);
            // From a place, the way need not lead through the centre of the place's ball.
            const bool leaves = leg.size() > 1 && at.ball == leg[0].ball && tour_.way.back().pin == Pin::beside;
            if (leaves && search_.is_free(0, tour_.way.back().at, search_.ball(leg[1]).centre)) continue;
            add(search_.ball(at).centre, Pin::none, at.stretch);
        }
        tour_.cost += search_.cost(node);
        tour_.flown += flown_on(leg);
    }

    // Extends the tour by a leg to the gate's entry and by the way through the gate. Returns the ball on the other
    // side.
    Node pass(Entry entry)
    {
        const Gate& through = search_.gate(entry);
        const std::size_t side = static_cast<std::size_t>(entry.number) % 2;
        const Node to = ball_before(entry);
        tour_.cost += search_.turn_cost(to, entry, heading());
        fly_to(to);
        const auto& in = through.ways[side];
        const auto& out = through.ways[1 - side];
        const double step = 0.5 * length_.frames_a_clearance;
        const auto go = [&](Vector p, Pin pin) {
            tour_.clock += step;
            add(p, pin, entry.stretch);
        };
        for (auto p = in.rbegin(); p + 1 != in.rend(); ++p) go(*p, Pin::none);
        go(through.centre, Pin::gate);
        for (std::size_t i = 1; i < out.size(); ++i) go(out[i], Pin::none);
        tour_.cost += 0.5 * static_cast<double>(in.size() + out.size());
        tour_.flown += 0.5 * static_cast<double>(in.size() + out.size());
        search_.mark_flown(entry);
        ++tour_.gates;
        return {entry.stretch, through.balls[1 - side]};
    }

    // Returns the part of the polyline that begins with the point number `point`, preceded by up to four older points.
    Polyline part_from(std::size_t point) const
    {
        const auto first = static_cast<std::ptrdiff_t>(point - std::min<std::size_t>(point, 4));
        return {tour_.way.begin() + first, tour_.way.end()};
    }

    // Returns a vector in the direction of the last points; zero if there are few points.
    Vector heading() const
    {
        const Polyline& way = tour_.way;
        return way.size() > 4 ? way.back().at - way[way.size() - 4].at : Vector{};
    }

    void add(Vector p, Pin pin, int stretch)
    {
        Polyline& way = tour_.way;
        if (!way.empty() && length(way.back().at - p) < 1e-9) return;
        way.push_back({p, pin, tour_.clock, search_.stretch(stretch).value});
    }

    Search search_;
    TourLength length_;
    FlightRandom& random_;
    const std::function<bool(const Polyline& part)>& fine_;
    std::span<const Visit> visits_;
    Tour tour_;
};

}  // namespace

Tour make_tour(std::span<const RoadmapSpan> stretches, const TourLength& length, FlightRandom& random,
               const std::function<bool(const Polyline& part)>& fine, std::span<const Visit> visits)
{
    return Guide(stretches, length, random, fine, visits).fly();
}

}  // namespace mandelmarch
