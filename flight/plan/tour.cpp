// SPDX-License-Identifier: Apache-2.0
#include "flight/plan/tour.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace mandelmarch {
namespace {

constexpr double start_distance = 2.5;  // of the eye from the middle, in hull sizes
constexpr double outside_penalty = 6;   // a way outside the hull counts so many times
constexpr double seen_penalty = 3;      // a way through balls flown through before
constexpr double turn_cost = 30;        // clearances that turning round costs: 180 degrees at the cap on turning
constexpr double reach = 400;           // clearances within which the next gate is sought
constexpr int choices = 10;             // gate entries looked at before choosing
constexpr double whim = 1.0;            // a gate's cost counts up to this much more, at random

double angle_between(Vector a, Vector b)
{
    const double product = length(a) * length(b);
    return product > 0 ? std::acos(std::clamp(dot(a, b) / product, -1.0, 1.0)) : 0;
}

class Guide {
public:
    Guide(const Field& field, const Balls& balls, const std::vector<Gate>& gates, Random& random)
        : field_(field),
          balls_(balls),
          gates_(gates),
          random_(random),
          seen_(balls.balls().size(), 0),
          cost_(balls.balls().size(), 0),
          before_(balls.balls().size(), -1),
          round_(balls.balls().size(), -1),
          entries_(balls.balls().size())
    {
        int kinds = 0;
        for (std::size_t g = 0; g < gates.size(); ++g) {
            for (std::size_t side = 0; side < 2; ++side) {
                entries_[static_cast<std::size_t>(gates[g].balls[side])].push_back(static_cast<int>(2 * g + side));
            }
            kinds = std::max(kinds, gates[g].kind + 1);
        }
        flown_.assign(static_cast<std::size_t>(kinds), 0);
    }

    Tour fly(double budget)
    {
        int at = start();
        const Vector first = balls_.balls()[static_cast<std::size_t>(at)].centre;
        const Vector eye = start_distance * field_.hull().size * unit(first);
        add(eye, false);
        add(first, false);
        while (tour_.cost < budget) {
            int entry = next(at);
            if (entry < 0) {
                // Every kind of gate in reach has been flown through: a long film begins again.
                std::ranges::fill(flown_, 0);
                std::ranges::fill(seen_, 0);
                entry = next(at);
            }
            if (entry < 0) break;
            pass(entry);
            const Gate& gate = gates_[static_cast<std::size_t>(entry) / 2];
            at = gate.balls[1 - static_cast<std::size_t>(entry) % 2];
        }
        return std::move(tour_);
    }

private:
    // A ball just outside the hull, drawn at random.
    int start()
    {
        std::vector<int> candidates;
        for (std::size_t i = 0; i < balls_.balls().size(); ++i) {
            const Ball& ball = balls_.balls()[i];
            if (ball.clearance > 0.1 * field_.hull().size && !field_.hull().contains(ball.centre) &&
                !balls_.links(static_cast<int>(i)).empty()) {
                candidates.push_back(static_cast<int>(i));
            }
        }
        if (candidates.empty()) return 0;
        return candidates[static_cast<std::size_t>(random_.share() * static_cast<double>(candidates.size()))];
    }

    // Dijkstra's search from ball `from` until enough gates are seen; returns the entry chosen (2 gate + side), with
    // the way to it in before_; -1 if there is none.
    int next(int from)
    {
        ++turn_;
        using Entry = std::pair<double, int>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        const auto relax = [&](int ball, double cost, int before) {
            const auto b = static_cast<std::size_t>(ball);
            if (round_[b] == turn_ && cost_[b] <= cost) return;
            round_[b] = turn_;
            cost_[b] = cost;
            before_[b] = before;
            queue.emplace(cost, ball);
        };
        relax(from, 0, -1);
        int best = -1;
        double best_cost = std::numeric_limits<double>::infinity();
        int found = 0;
        while (!queue.empty() && found < choices) {
            const auto [cost, ball] = queue.top();
            queue.pop();
            const auto b = static_cast<std::size_t>(ball);
            if (cost > cost_[b]) continue;
            if (cost > reach) break;
            for (const int entry : entries_[b]) {
                const Gate& gate = gates_[static_cast<std::size_t>(entry) / 2];
                if (flown_[static_cast<std::size_t>(gate.kind)] != 0) continue;
                ++found;
                const double wanted = (10 + cost + turn_cost / std::numbers::pi * turning(ball, entry)) *
                                      (1 + whim * random_.share()) / (0.4 + gate.walled);
                if (wanted < best_cost) {
                    best_cost = wanted;
                    best = entry;
                }
            }
            for (const Link& link : balls_.links(ball)) {
                const auto to = static_cast<std::size_t>(link.to);
                const Ball& there = balls_.balls()[to];
                const double clearance =
                    std::min(0.5 * (std::min(link.clearance, there.clearance) + balls_.balls()[b].clearance),
                             fastest_clearance(field_.hull()));
                double step = link.length / clearance;
                if (!field_.hull().contains(there.centre)) step *= outside_penalty;
                if (seen_[to] != 0) step *= seen_penalty;
                relax(link.to, cost + step, ball);
            }
        }
        return best;
    }

    // Angles that the way to a gate turns by, radians: from the last way out into the leg, and from the leg into the
    // gate.
    double turning(int ball, int entry) const
    {
        std::vector<int> leg = leg_to(ball);
        if (leg.size() < 2) return 0;
        const auto centre = [&](std::size_t i) { return balls_.balls()[static_cast<std::size_t>(leg[i])].centre; };
        const std::size_t some = std::min<std::size_t>(4, leg.size() - 1);
        const auto& way = gates_[static_cast<std::size_t>(entry) / 2].ways[static_cast<std::size_t>(entry) % 2];
        const Vector into = way.front() - way.back();
        double sum = angle_between(centre(leg.size() - 1) - centre(leg.size() - 1 - some), into);
        if (tour_.way.points.size() > 4) {
            const auto& done = tour_.way.points;
            sum += angle_between(done.back() - done[done.size() - 4], centre(some) - centre(0));
        }
        return sum;
    }

    std::vector<int> leg_to(int ball) const
    {
        std::vector<int> leg;
        for (int at = ball; at >= 0; at = before_[static_cast<std::size_t>(at)]) leg.push_back(at);
        std::ranges::reverse(leg);
        return leg;
    }

    // Flies the leg to the gate, in at the entry's side and out at the other.
    void pass(int entry)
    {
        const Gate& gate = gates_[static_cast<std::size_t>(entry) / 2];
        const std::size_t side = static_cast<std::size_t>(entry) % 2;
        const int ball = gate.balls[side];
        tour_.cost += cost_[static_cast<std::size_t>(ball)] + turn_cost / std::numbers::pi * turning(ball, entry);
        for (const int at : leg_to(ball)) {
            seen_[static_cast<std::size_t>(at)] = 1;
            for (const Link& link : balls_.links(at)) seen_[static_cast<std::size_t>(link.to)] = 1;
            add(balls_.balls()[static_cast<std::size_t>(at)].centre, false);
        }
        const auto& in = gate.ways[side];
        const auto& out = gate.ways[1 - side];
        for (auto p = in.rbegin(); p + 1 != in.rend(); ++p) add(*p, false);
        add(gate.centre, true);
        for (std::size_t i = 1; i < out.size(); ++i) add(out[i], false);
        tour_.cost += 0.5 * static_cast<double>(in.size() + out.size());
        flown_[static_cast<std::size_t>(gate.kind)] = 1;
        ++tour_.gates;
    }

    void add(Vector p, bool pin)
    {
        auto& [points, pinned] = tour_.way;
        if (!points.empty() && length(points.back() - p) < 1e-9) return;
        points.push_back(p);
        pinned.push_back(pin ? 1 : 0);
    }

    const Field& field_;
    const Balls& balls_;
    const std::vector<Gate>& gates_;
    Random& random_;
    std::vector<char> seen_;   // balls flown through, and their neighbours
    std::vector<char> flown_;  // kinds of gates
    // Dijkstra's labels, valid where round_ is the current turn.
    std::vector<double> cost_;
    std::vector<int> before_, round_;
    int turn_ = 0;
    std::vector<std::vector<int>> entries_;  // of each ball: 2 gate + side
    Tour tour_;
};

}  // namespace

double fastest_clearance(const Hull& hull) { return 0.1 * hull.size; }

Tour make_tour(const Field& field, const Balls& balls, const std::vector<Gate>& gates, double budget, Random& random)
{
    return Guide(field, balls, gates, random).fly(budget);
}

}  // namespace mandelmarch
