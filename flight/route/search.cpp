// SPDX-License-Identifier: Apache-2.0
#include "flight/route/search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mandelmarch {
namespace {

// The cost of a way is its length in clearances, times penalties.
constexpr double outside_penalty = 6;  // factor for ways outside the bounds, and for gates that lead there
constexpr double seen_penalty = 3;     // factor for ways to balls that the tour has visited
constexpr double whole_turn = 30;      // cost of a turn by 180 degrees
constexpr double gate_reach = 400;     // largest cost of the way to the next gate
constexpr int choices = 10;            // number of gate entries after which the search ends
constexpr double whim = 1.0;           // largest random increase of a gate's cost, as a multiple of the cost
// For shapes that change in flight:
constexpr double changing_reach = 70;  // clearances, without penalties; farther gates move before the camera arrives
constexpr double stroll_reach = 40;    // clearances; largest distance of the fallback (see Search::stroll)
constexpr double same_gate = 0.03;     // fractal sizes; two gates of different shapes count as one if they are closer
// If no ball contains the place, near() accepts another ball under three conditions:
constexpr double over = 4;          // - its centre is closer to the place than this, in clearances of the ball;
constexpr std::size_t tried = 24;   // - it is one of this number of closest balls;
constexpr double free_share = 0.3;  // - all estimates in between exceed this fraction of the roadmap's least clearance.

double angle_between(Vector a, Vector b)
{
    const double product = length(a) * length(b);
    return product > 0 ? std::acos(std::clamp(dot(a, b) / product, -1.0, 1.0)) : 0;
}

}  // namespace

Search::Search(std::span<const RoadmapSpan> stretches, double frames_a_clearance)
    : stretches_(stretches), frames_a_clearance_(frames_a_clearance)
{
    for (const RoadmapSpan& stretch : stretches) {
        const Roadmap& roads = *stretch.roads;
        offsets_.push_back(entries_.size());
        entries_.resize(entries_.size() + roads.balls.balls().size());
        int kinds = 0;
        for (const Ball& ball : roads.balls.balls()) states_.push_back({!roads.field.bounds().contains(ball.centre)});
        for (std::size_t g = 0; g < roads.gates.size(); ++g) {
            for (std::size_t side = 0; side < 2; ++side) {
                const std::size_t b = offsets_.back() + static_cast<std::size_t>(roads.gates[g].balls[side]);
                entries_[b].push_back(static_cast<int>(2 * g + side));
                states_[b].entry = true;
            }
            kinds = std::max(kinds, roads.gates[g].kind + 1);
        }
        flown_.emplace_back(static_cast<std::size_t>(kinds), 0);
    }
}

bool Search::is_free(int stretch, Vector from, Vector to) const
{
    const double floor = free_share * roads(stretch).balls.least();
    return field(stretch).least_between(from, to, floor) > floor;
}

Node Search::near(int stretch, Vector place) const
{
    const Roadmap& there = roads(stretch);
    const int holding = there.balls.holding(place);
    if (holding >= 0) return {stretch, holding};
    std::vector<std::pair<double, int>> nearest;
    for (std::size_t b = 0; b < there.balls.balls().size(); ++b) {
        const Ball& ball = there.balls.balls()[b];
        const double apart = length(ball.centre - place) / ball.clearance;
        if (apart < over && !there.balls.links(static_cast<int>(b)).empty())
            nearest.emplace_back(apart, static_cast<int>(b));
    }
    std::ranges::sort(nearest);
    if (nearest.size() > tried) nearest.resize(tried);
    for (const auto& [apart, b] : nearest) {
        const Vector centre = there.balls.balls()[static_cast<std::size_t>(b)].centre;
        if (is_free(stretch, centre, place)) return {stretch, b};
    }
    return {};
}

void Search::relax(Queue& queue, Node node, double cost, double clock, Node before)
{
    State& state = states_[index(node)];
    if (state.round == turn_ && state.cost <= cost) return;
    state.round = turn_;
    state.cost = cost;
    state.clock = clock;
    state.before = before;
    queue.emplace(cost, node);
}

double Search::with_penalties(double steps, Node to) const
{
    const State& state = states_[index(to)];
    if (state.outside) steps *= outside_penalty;
    if (state.seen) steps *= seen_penalty;
    return steps;
}

bool Search::find(Node from, Node to)
{
    ++turn_;
    Queue queue;
    relax(queue, from, 0, 0, {});
    while (!queue.empty()) {
        const auto [cost, node] = queue.top();
        queue.pop();
        if (cost > states_[index(node)].cost) continue;
        if (node.ball == to.ball) return true;
        for (const Link& link : roads(node.stretch).balls.links(node.ball)) {
            const Node next{node.stretch, link.to};
            relax(queue, next, cost + with_penalties(link.steps, next), 0, node);
        }
    }
    return false;
}

Entry Search::next(Node from, double clock, Vector heading, FlightRandom& random)
{
    ++turn_;
    Queue queue;
    relax(queue, from, 0, clock, {});
    Entry best;
    stroll_ = {};
    double best_cost = std::numeric_limits<double>::infinity();
    int found = 0;
    const int most = std::min(choices, left());
    while (!queue.empty() && found < most) {
        const auto [cost, node] = queue.top();
        queue.pop();
        const std::size_t b = index(node);
        const State& state = states_[b];
        if (cost > state.cost) continue;
        if (cost > gate_reach) break;
        const double way = frames_a_clearance_ > 0 ? (state.clock - clock) / frames_a_clearance_ : 0;
        if (way > changing_reach) continue;
        const Roadmap& here = roads(node.stretch);
        if (state.clock > stretch(node.stretch).until) {
            const Node on{node.stretch + 1, roads(node.stretch + 1).balls.holding(ball(node).centre)};
            if (on.ball >= 0) relax(queue, on, cost, state.clock, node);
            continue;
        }
        if (way > stroll_reach / 4 && way < stroll_reach && !state.outside) stroll_ = node;
        for (const int entry : state.entry ? std::span<const int>(entries_[b]) : std::span<const int>()) {
            const Gate& gate = here.gates[static_cast<std::size_t>(entry) / 2];
            if (flown_[static_cast<std::size_t>(node.stretch)][static_cast<std::size_t>(gate.kind)] != 0) continue;
            ++found;
            const Node behind{node.stretch, gate.balls[1 - static_cast<std::size_t>(entry) % 2]};
            const double wanted = (10 + cost + turn_cost(node, {node.stretch, entry}, heading)) *
                                  (1 + whim * random.share()) / (0.4 + gate.walled) *
                                  (states_[index(behind)].outside ? outside_penalty : 1);
            if (wanted < best_cost) {
                best_cost = wanted;
                best = {node.stretch, entry};
            }
        }
        // The search waits for memory less if the balls of all links are fetched at once.
        const auto links = here.balls.links(node.ball);
        for (const Link& link : links) __builtin_prefetch(&states_[index({node.stretch, link.to})]);
        if (!queue.empty() && queue.top().second.stretch == node.stretch) {
            __builtin_prefetch(here.balls.links(queue.top().second.ball).data());
        }
        for (const Link& link : links) {
            const Node to{node.stretch, link.to};
            relax(queue, to, cost + with_penalties(link.steps, to), state.clock + link.steps * frames_a_clearance_,
                  node);
        }
    }
    return best;
}

int Search::left() const
{
    if (frames_a_clearance_ > 0) return choices;
    const auto flown = [this](const Gate& gate) { return flown_[0][static_cast<std::size_t>(gate.kind)] != 0; };
    const auto& gates = roads(0).gates;
    return 2 * static_cast<int>(std::ranges::count_if(gates, std::not_fn(flown)));
}

double Search::turn_cost(Node node, Entry entry, Vector heading) const
{
    const std::vector<Node> leg = leg_to(node);
    if (leg.size() < 2) return 0;
    const auto centre = [&](std::size_t i) { return ball(leg[i]).centre; };
    const std::size_t some = std::min<std::size_t>(4, leg.size() - 1);
    const auto& way = gate(entry).ways[static_cast<std::size_t>(entry.number) % 2];
    const Vector into = way.front() - way.back();
    return whole_turn / std::numbers::pi *
           (angle_between(centre(leg.size() - 1) - centre(leg.size() - 1 - some), into) +
            angle_between(heading, centre(some) - centre(0)));
}

std::vector<Node> Search::leg_to(Node node) const
{
    std::vector<Node> leg;
    for (Node at = node; at.ball >= 0; at = states_[index(at)].before) leg.push_back(at);
    std::ranges::reverse(leg);
    return leg;
}

void Search::see(Node node)
{
    for (int stretch = node.stretch; stretch < static_cast<int>(stretches_.size()); ++stretch) {
        const Node there =
            stretch == node.stretch ? node : Node{stretch, roads(stretch).balls.holding(ball(node).centre)};
        if (there.ball < 0) continue;
        states_[index(there)].seen = true;
        for (const Link& link : roads(stretch).balls.links(there.ball)) states_[index({stretch, link.to})].seen = true;
    }
}

void Search::mark_flown(Entry entry)
{
    const Gate& done = gate(entry);
    flown_[static_cast<std::size_t>(entry.stretch)][static_cast<std::size_t>(done.kind)] = 1;
    for (int other = 0; other < static_cast<int>(stretches_.size()); ++other) {
        if (other == entry.stretch) continue;
        const DistanceField& there = field(other);
        const Vector place = there.representative(done.centre);
        for (const Gate& gate : roads(other).gates) {
            if (length(there.representative(gate.centre) - place) < same_gate * there.bounds().size)
                flown_[static_cast<std::size_t>(other)][static_cast<std::size_t>(gate.kind)] = 1;
        }
    }
}

void Search::forget()
{
    for (auto& kinds : flown_) std::ranges::fill(kinds, 0);
    for (State& state : states_) state.seen = false;
}

}  // namespace mandelmarch
