// SPDX-License-Identifier: Apache-2.0
#include "flight/route/gates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "flight/field/threads.h"
#include "flight/route/random.h"

namespace mandelmarch {
namespace {

constexpr double look = 1.5;       // clearances; the estimates around a point are sampled at this distance
constexpr double ring_radius = 7;  // clearances; rays of the ring must hit a wall within this distance
constexpr std::size_t lines = 32;  // candidates for a gate's axis
constexpr int ring_rays = 16;      // rays from a gate's centre, perpendicular to its axis
constexpr double widening = 2.3;   // clearances of the gate; a way out must lead to a point with a larger clearance
constexpr double same_place = 2;   // clearances; two gates that are closer count as one

// Returns 13 directions: the axes through the faces, edges and corners of a cube.
std::array<Vector, 13> compass()
{
    std::array<Vector, 13> directions;
    std::size_t n = 0;
    for (int code = 14; code < 27; ++code) {
        const int plane = code / 9;
        const int row = code / 3 % 3;
        directions[n++] = unit({code % 3 - 1.0, row - 1.0, plane - 1.0});
    }
    return directions;
}

// Returns two unit vectors that are perpendicular to each other and to `axis`, which must be a unit vector.
std::pair<Vector, Vector> across(Vector axis)
{
    const Vector helper = std::abs(axis.x) < 0.6 ? Vector{1, 0, 0} : Vector{0, 1, 0};
    const Vector u = unit(cross(axis, helper));
    return {u, cross(axis, u)};
}

class Finder {
public:
    Finder(const DistanceField& field, const Balls& balls, double least, double most)
        : field_(field), balls_(balls), least_(least), most_(most), enough_(9.0 / ring_rays)
    {
    }

    // Searches for a gate around a free point. Returns nullopt if none is found.
    std::optional<Gate> from(Ball place) const
    {
        Gate gate{place.centre, {}, place.clearance, 0, {}, {}, 0};
        if (!tunnel(gate) || ringed(gate) < enough_ || !centre(gate)) return std::nullopt;
        if (gate.clearance < least_ || gate.clearance > most_) return std::nullopt;
        if (!leave(gate, 0) || !leave(gate, 1)) return std::nullopt;
        narrow(gate);
        gate.walled = ringed(gate);
        if (gate.clearance < least_ || gate.walled < enough_) return std::nullopt;
        return gate;
    }

private:
    // Sets gate.axis to the direction in which there is most space. For this, 13 lines through the centre are compared.
    // The openness of a line is the smaller of the estimates at its two ends, in clearances.
    void find_axis(Gate& gate) const
    {
        static const auto directions = compass();
        std::array<Vector, 26> points;
        std::array<double, 26> clear{};
        const double reach = look * gate.clearance;
        for (std::size_t k = 0; k < 13; ++k) {
            points[2 * k] = gate.centre + reach * directions[k];
            points[2 * k + 1] = gate.centre - reach * directions[k];
        }
        field_.distances(points, clear);
        // The principal axis is found by power iteration on the sum of openness^3 d d^T over the lines' directions d.
        // The iteration starts with the most open direction.
        std::array<double, 13> open{};
        std::size_t best = 0;
        for (std::size_t k = 0; k < 13; ++k) {
            open[k] = std::min(clear[2 * k], clear[2 * k + 1]) / gate.clearance;
            if (open[k] > open[best]) best = k;
        }
        Vector axis = directions[best];
        for (int round = 0; round < 8; ++round) {
            Vector sum{};
            for (std::size_t k = 0; k < 13; ++k) {
                sum = sum + open[k] * open[k] * open[k] * dot(directions[k], axis) * directions[k];
            }
            axis = unit(sum);
        }
        gate.axis = dot(axis, gate.axis) < 0 ? -1 * axis : axis;
    }

    // Sets gate.axis to the best of 32 lines through the centre. Lines that hit a wall at one of their ends are left
    // out. The best line is the one for which the fraction of directions across it that hit a wall is the largest.
    // Returns false if this fraction is smaller than enough_.
    bool tunnel(Gate& gate) const
    {
        static const auto directions = [] {
            std::array<Vector, 2 * lines> all;
            for (std::size_t k = 0; k < lines; ++k) {
                const double z = (static_cast<double>(k) + 0.5) / lines;
                const double angle = static_cast<double>(k) * std::numbers::pi * (3 - std::sqrt(5.0));
                const double rho = std::sqrt(1 - z * z);
                all[k] = {rho * std::cos(angle), rho * std::sin(angle), z};
                all[lines + k] = -1 * all[k];
            }
            return all;
        }();
        std::array<Vector, 2 * lines> from;
        from.fill(gate.centre);
        std::array<double, 2 * lines> t{};
        const double end = ring_radius * gate.clearance;
        const field::Reach reach{.floor = 0.05 * gate.clearance, .tolerance = 0, .end = end, .steps = 30};
        // Most points are rejected by a quick test: of 16 directions, at least half must hit a wall.
        std::array<Vector, 16> few;
        for (std::size_t k = 0; k < few.size(); ++k) few[k] = directions[k * 2 * lines / few.size() + k % 2];
        field_.casts({from.data(), few.size()}, few, reach, {t.data(), few.size()});
        if (std::count_if(t.begin(), t.begin() + 16, [&](double reached) { return reached < end; }) < 8) return false;
        field_.casts(from, directions, reach, t);
        double best = 0;
        for (std::size_t k = 0; k < lines; ++k) {
            if (std::min(t[k], t[lines + k]) < end) continue;
            int wall = 0;
            int all = 0;
            for (std::size_t l = 0; l < 2 * lines; ++l) {
                if (std::abs(dot(directions[k], directions[l])) > 0.3) continue;
                ++all;
                wall += t[l] < end ? 1 : 0;
            }
            const double share = static_cast<double>(wall) / all;
            if (share <= best) continue;
            best = share;
            gate.axis = directions[k];
        }
        return best >= enough_;
    }

    // Moves the gate's centre to a saddle point of the clearance: a maximum across the axis and a minimum along it.
    // Returns false if no saddle point is nearby.
    bool centre(Gate& gate) const
    {
        const double home = gate.clearance;
        const Vector start = gate.centre;
        double step = 0.5;
        for (int round = 0; round < 24; ++round) {
            if (round % 6 == 5) find_axis(gate);
            const auto [u, v] = across(gate.axis);
            const double reach = step * gate.clearance;
            std::array<Vector, 10> points;
            std::array<double, 10> clear{};
            for (int k = 0; k < 8; ++k) {
                const double angle = k * std::numbers::pi / 4;
                points[static_cast<std::size_t>(k)] =
                    gate.centre + reach * std::cos(angle) * u + reach * std::sin(angle) * v;
            }
            points[8] = gate.centre + reach * gate.axis;
            points[9] = gate.centre - reach * gate.axis;
            field_.distances(points, clear);
            const auto widest =
                static_cast<std::size_t>(std::max_element(clear.begin(), clear.begin() + 8) - clear.begin());
            const std::size_t narrower = clear[8] < clear[9] ? 8 : 9;
            std::size_t to = 10;
            if (clear[widest] > gate.clearance * 1.001) {
                to = widest;
            } else if (clear[narrower] < gate.clearance * 0.999 && clear[narrower] > 0) {
                to = narrower;
            }
            if (to < 10) {
                gate.centre = points[to];
                gate.clearance = clear[to];
            } else {
                step *= 0.6;
            }
            if (gate.clearance < 0.5 * least_ || gate.clearance > 3 * home || length(gate.centre - start) > 8 * home) {
                return false;
            }
            if (step < 0.03) break;
        }
        return true;
    }

    // Returns the fraction of rays perpendicular to the axis that hit a wall.
    double ringed(const Gate& gate) const
    {
        const auto [u, v] = across(gate.axis);
        std::array<Vector, ring_rays> from;
        std::array<Vector, ring_rays> along;
        std::array<double, ring_rays> t{};
        for (std::size_t k = 0; k < ring_rays; ++k) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(k) / ring_rays;
            from[k] = gate.centre;
            along[k] = std::cos(angle) * u + std::sin(angle) * v;
        }
        const double end = ring_radius * gate.clearance;
        field_.casts(from, along, {.floor = 0.03 * gate.clearance, .tolerance = 0, .end = end, .steps = 200}, t);
        const auto wall = std::ranges::count_if(t, [&](double reached) { return reached < end; });
        return static_cast<double>(wall) / ring_rays;
    }

    // Follows a way out of the gate until it reaches a ball in wider space. Each step compares nine directions around
    // the direction of the previous step and takes the one that leads to the largest clearance. Returns false if no way
    // out is found. `way`: 0 along the axis, 1 against it.
    bool leave(Gate& gate, int way) const
    {
        Vector direction = way == 0 ? gate.axis : -1 * gate.axis;
        Vector at = gate.centre;
        double clear = gate.clearance;
        std::vector<Vector>& out = gate.ways[static_cast<std::size_t>(way)];
        out = {at};
        bool wide = false;
        for (int step = 0; step < 120; ++step) {
            const auto [u, v] = across(direction);
            std::array<Vector, 9> headings;
            headings[0] = direction;
            for (std::size_t k = 1; k < 9; ++k) {
                const double angle = static_cast<double>(k) * std::numbers::pi / 4;
                headings[k] = unit(direction + 0.6 * std::cos(angle) * u + 0.6 * std::sin(angle) * v);
            }
            std::array<Vector, 9> points;
            std::array<double, 9> found{};
            for (std::size_t k = 0; k < 9; ++k) points[k] = at + 0.5 * clear * headings[k];
            field_.distances(points, found);
            found[0] *= 1.02;  // prefers the way straight on
            const auto best = static_cast<std::size_t>(std::ranges::max_element(found) - found.begin());
            at = points[best];
            clear = best == 0 ? found[0] / 1.02 : found[best];
            direction = unit(direction + 0.7 * headings[best]);
            if (clear < least_) return false;
            out.push_back(at);
            wide = wide || clear > widening * gate.clearance;
            const int ball = balls_.holding(at);
            if (wide && ball >= 0) {
                gate.balls[static_cast<std::size_t>(way)] = ball;
                return length(at - gate.centre) > 1.5 * gate.clearance;
            }
        }
        return false;
    }

    // Moves the centre to the narrowest point of the two ways out.
    void narrow(Gate& gate) const
    {
        std::vector<Vector> whole(gate.ways[1].rbegin(), gate.ways[1].rend());
        whole.insert(whole.end(), gate.ways[0].begin() + 1, gate.ways[0].end());
        std::vector<double> clear(whole.size());
        field_.distances(whole, clear);
        const auto at = std::ranges::min_element(clear) - clear.begin();
        gate.centre = whole[static_cast<std::size_t>(at)];
        gate.clearance = clear[static_cast<std::size_t>(at)];
        gate.ways[0].assign(whole.begin() + at, whole.end());
        gate.ways[1].assign(whole.rend() - at - 1, whole.rend());
        const auto ahead = static_cast<std::size_t>(std::min<std::ptrdiff_t>(at + 1, std::ssize(whole) - 1));
        const auto behind = static_cast<std::size_t>(std::max<std::ptrdiff_t>(at - 1, 0));
        gate.axis = unit(whole[ahead] - whole[behind]);
    }

    const DistanceField& field_;
    const Balls& balls_;
    double least_, most_;
    double enough_;  // fraction of the ring's rays that must hit a wall
};

}  // namespace

std::vector<Gate> find_gates(const DistanceField& field, const Balls& balls, const GateSearch& search,
                             std::vector<Gate> known, std::span<const Ball> also)
{
    const auto [least, most, tries] = search;
    // The starting points are chosen with a fixed seed, so that all tours choose among the same gates.
    std::vector<Ball> places(also.begin(), also.end());
    FlightRandom random(1);
    const double share = static_cast<double>(tries) / std::max(static_cast<double>(balls.narrows().size()), 1.0);
    for (const Ball& place : balls.narrows()) {
        if (random.share() < share && place.clearance < most) places.push_back(place);
    }
    std::vector<std::optional<Gate>> found(places.size());
    const Finder finder(field, balls, least, most);
    parallel(places.size(), 64, field.threads(), [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) found[i] = finder.from(places[i]);
    });
    std::vector<Gate> gates = std::move(known);
    std::vector<Vector> kinds;
    for (const Gate& gate : gates) {
        if (static_cast<std::size_t>(gate.kind) == kinds.size()) kinds.push_back(field.representative(gate.centre));
    }
    for (auto& gate : found) {
        if (!gate) continue;
        const auto same = [&](const Gate& other) {
            return length(other.centre - gate->centre) < same_place * std::max(gate->clearance, other.clearance);
        };
        if (std::ranges::any_of(gates, same)) continue;
        const Vector here = field.representative(gate->centre);
        const auto kind = std::ranges::find_if(
            kinds, [&](Vector other) { return length(other - here) < same_place * gate->clearance; });
        gate->kind = static_cast<int>(kind - kinds.begin());
        if (kind == kinds.end()) kinds.push_back(here);
        gates.push_back(std::move(*gate));
    }
    return gates;
}

}  // namespace mandelmarch
