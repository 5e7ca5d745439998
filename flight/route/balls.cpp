// SPDX-License-Identifier: Apache-2.0
#include "flight/route/balls.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "flight/field/threads.h"

namespace mandelmarch {
namespace {

constexpr double margin = 1.2;        // fractal sizes; half the edge of the cube that is filled with balls
constexpr double cover_share = 0.95;  // fraction of a ball's radius within which no further ball is centred
constexpr double overlap = 0.95;      // centres of linked balls are closer than this fraction of the sum of their radii

}  // namespace

Balls::Balls(const DistanceField& field, double least, double narrow, int coarse)
    : field_(field),
      least_(least),
      narrow_(narrow),
      coarse_(coarse),
      fine_(coarse * parts),
      half_(margin * field.bounds().size),
      side_(2 * half_ / fine_)
{
    flood();
    cover();
    samples_ = {};
    link();
    keep_outside_component();
}

Balls::Cell Balls::cell_of(Vector p) const
{
    const auto along = [this](double c) {
        return std::clamp(static_cast<int>(std::floor((c + half_) / side_)), 0, fine_ - 1);
    };
    return {along(p.x), along(p.y), along(p.z)};
}

Vector Balls::centre_of(Cell c) const
{
    return {(c.x + 0.5) * side_ - half_, (c.y + 0.5) * side_ - half_, (c.z + 0.5) * side_ - half_};
}

template <class Visit>
void Balls::each_cell_near(Vector p, double radius, Visit visit) const
{
    const Cell low = cell_of({p.x - radius, p.y - radius, p.z - radius});
    const Cell high = cell_of({p.x + radius, p.y + radius, p.z + radius});
    const double square = radius * radius;
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                const Vector away = centre_of({x, y, z}) - p;
                if (dot(away, away) <= square) visit(index({x, y, z}));
            }
        }
    }
}

// Samples the free space by a flood fill over coarse cells that starts at an edge of the cube. If the ball around a
// cell's centre covers the cell, the cell gives one sample; otherwise it is divided into fine cells, which are sampled.
// The fill crosses a face of a cell only if there is a free fine cell at that face. It therefore never enters the solid
// interior, where DE evaluations are expensive.
void Balls::flood()
{
    const double half_diagonal = side_ * parts * std::sqrt(0.75);
    const auto along = static_cast<std::size_t>(coarse_);
    std::vector<char> seen(along * along * along, 0);
    const auto coarse_index = [along](Cell c) {
        return (static_cast<std::size_t>(c.z) * along + static_cast<std::size_t>(c.y)) * along +
               static_cast<std::size_t>(c.x);
    };
    const auto middle = [](Cell c) {
        return Cell{c.x * parts + parts / 2, c.y * parts + parts / 2, c.z * parts + parts / 2};
    };
    const Cell start{coarse_ - 1, coarse_ / 2, coarse_ - 1};
    std::vector<Cell> wave{start};
    seen[coarse_index(start)] = 1;
    std::vector<Vector> points;
    std::vector<double> clear;
    while (!wave.empty()) {
        points.clear();
        for (const Cell c : wave) points.push_back(centre_of(middle(c)));
        clear.resize(points.size());
        field_.distances(points, clear);
        std::vector<Cell> cut;
        std::vector<std::pair<Cell, unsigned>> open;  // cells, each with a bit for each face that can be crossed
        for (std::size_t i = 0; i < wave.size(); ++i) {
            if (field_.safety() * clear[i] >= half_diagonal) {
                samples_.push_back({points[i], clear[i]});
                open.emplace_back(wave[i], 63U);
            } else {
                cut.push_back(wave[i]);
            }
        }
        points.clear();
        for (const Cell c : cut) {
            for (int k = 0; k < parts * parts * parts; ++k) {
                points.push_back(centre_of(
                    {c.x * parts + k % parts, c.y * parts + k / parts % parts, c.z * parts + k / (parts * parts)}));
            }
        }
        clear.resize(points.size());
        field_.distances(points, clear);
        for (std::size_t i = 0, at = 0; i < cut.size(); ++i) {
            unsigned faces = 0;
            for (int k = 0; k < parts * parts * parts; ++k, ++at) {
                if (clear[at] >= narrow_ && field_.bounds().contains(points[at])) {
                    narrows_.push_back({points[at], clear[at]});
                }
                if (clear[at] < least_) continue;
                samples_.push_back({points[at], clear[at]});
                const int x = k % parts;
                const int y = k / parts % parts;
                const int z = k / (parts * parts);
                faces |= (x == 0 ? 1U : 0) | (x == parts - 1 ? 2U : 0) | (y == 0 ? 4U : 0) | (y == parts - 1 ? 8U : 0) |
                         (z == 0 ? 16U : 0) | (z == parts - 1 ? 32U : 0);
            }
            open.emplace_back(cut[i], faces);
        }
        wave.clear();
        for (const auto& [c, faces] : open) {
            for (int face = 0; face < 6; ++face) {
                if ((faces >> face & 1U) == 0) continue;
                Cell to = c;
                (face < 2 ? to.x : face < 4 ? to.y : to.z) += face % 2 == 0 ? -1 : 1;
                if (std::min({to.x, to.y, to.z}) < 0 || std::max({to.x, to.y, to.z}) >= coarse_) continue;
                if (seen[coarse_index(to)] != 0) continue;
                if (!field_.worth_searching(centre_of(middle(to)))) continue;
                seen[coarse_index(to)] = 1;
                wave.push_back(to);
            }
        }
    }
}

// Makes balls of the samples, the largest first. Skips samples that lie well inside an existing ball.
void Balls::cover()
{
    std::vector<std::uint32_t> order(samples_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
    std::ranges::stable_sort(order, [this](auto a, auto b) { return samples_[a].clearance > samples_[b].clearance; });
    const auto along = static_cast<std::size_t>(fine_);
    owner_.assign(along * along * along, -1);
    for (const auto i : order) {
        const Ball& ball = samples_[i];
        if (owner_[index(cell_of(ball.centre))] >= 0) continue;
        const auto number = static_cast<std::int32_t>(balls_.size());
        balls_.push_back(ball);
        owner_[index(cell_of(ball.centre))] = number;
        each_cell_near(ball.centre, cover_share * field_.safety() * ball.clearance, [&](std::size_t at) {
            if (owner_[at] < 0) owner_[at] = number;
        });
    }
}

void Balls::find_ways(std::vector<Way>& ways, std::vector<Way>& gaps) const
{
    constexpr std::size_t grain = 512;
    struct Part {
        std::vector<Way> ways, gaps;
    };
    std::vector<Part> found(balls_.size() / grain + 1);
    const double safety = field_.safety();
    parallel(balls_.size(), grain, field_.threads(), [&](std::size_t first, std::size_t last) {
        Part& part = found[first / grain];
        std::vector<std::int32_t> near;
        for (std::size_t i = first; i < last; ++i) {
            const Ball& a = balls_[i];
            near.clear();
            each_cell_near(a.centre, std::max(1.4 * safety * a.clearance, 1.8 * side_), [&](std::size_t at) {
                // Each pair is found once, from its larger ball, which has the smaller index.
                if (owner_[at] > static_cast<std::int32_t>(i) && (near.empty() || near.back() != owner_[at]))
                    near.push_back(owner_[at]);
            });
            std::ranges::sort(near);
            near.erase(std::unique(near.begin(), near.end()), near.end());
            for (const auto number : near) {
                const Ball& b = balls_[static_cast<std::size_t>(number)];
                const double apart = length(b.centre - a.centre);
                const Way way{static_cast<int>(i), number, apart, b.clearance};
                if (apart < overlap * safety * (a.clearance + b.clearance)) {
                    part.ways.push_back(way);
                } else if (apart < 2 * safety * (a.clearance + b.clearance)) {
                    part.gaps.push_back(way);
                }
            }
        }
    });
    for (const Part& part : found) {
        ways.insert(ways.end(), part.ways.begin(), part.ways.end());
        gaps.insert(gaps.end(), part.gaps.begin(), part.gaps.end());
    }
}

// Links pairs of balls that overlap, and pairs for which a ball at the midpoint of their centres would overlap both.
void Balls::link()
{
    std::vector<Way> ways;
    std::vector<Way> gaps;
    find_ways(ways, gaps);
    const auto ball = [this](int number) -> const Ball& { return balls_[static_cast<std::size_t>(number)]; };
    std::vector<Vector> middles;
    middles.reserve(gaps.size());
    for (const Way& gap : gaps) middles.push_back(0.5 * (ball(gap.a).centre + ball(gap.b).centre));
    std::vector<double> clear(middles.size());
    field_.distances(middles, clear);
    for (std::size_t i = 0; i < gaps.size(); ++i) {
        const auto [a, b, length, least] = gaps[i];
        if (clear[i] < least_ || length / 2 >= overlap * field_.safety() * (clear[i] + least)) continue;
        ways.push_back({a, b, length, std::min(clear[i], least)});
    }
    // Counts each ball's links, and places them one ball after another.
    first_link_.assign(balls_.size() + 1, 0);
    for (const Way& way : ways) {
        for (const int end : {way.a, way.b}) ++first_link_[static_cast<std::size_t>(end) + 1];
    }
    std::partial_sum(first_link_.begin(), first_link_.end(), first_link_.begin());
    links_.resize(first_link_.back());
    std::vector<std::size_t> next = first_link_;
    const double fastest = fastest_clearance(field_.bounds());
    for (const Way& way : ways) {
        for (const auto& [from, to] : {std::pair(way.a, way.b), std::pair(way.b, way.a)}) {
            const double clearance =
                std::min(0.5 * (std::min(way.clearance, ball(to).clearance) + ball(from).clearance), fastest);
            links_[next[static_cast<std::size_t>(from)]++] = {to, way.length / clearance};
        }
    }
}

// Finds the balls that are not connected with the outside and removes them from owner_, so that holding() never returns
// one of them.
void Balls::keep_outside_component()
{
    if (balls_.empty()) return;
    std::vector<char> reached(balls_.size(), 0);
    std::vector<int> stack{0};  // begins with the largest ball, which lies outside the fractal
    reached[static_cast<std::size_t>(stack[0])] = 1;
    while (!stack.empty()) {
        const int at = stack.back();
        stack.pop_back();
        for (const Link& link : links(at)) {
            if (reached[static_cast<std::size_t>(link.to)] != 0) continue;
            reached[static_cast<std::size_t>(link.to)] = 1;
            stack.push_back(link.to);
        }
    }
    for (auto& owner : owner_) {
        if (owner >= 0 && reached[static_cast<std::size_t>(owner)] == 0) owner = -1;
    }
}

int Balls::holding(Vector p) const
{
    if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) >= half_) return -1;
    const int number = owner_[index(cell_of(p))];
    if (number < 0) return -1;
    const Ball& ball = balls_[static_cast<std::size_t>(number)];
    return length(p - ball.centre) < overlap * field_.safety() * ball.clearance ? number : -1;
}

}  // namespace mandelmarch
