// SPDX-License-Identifier: Apache-2.0
// The free space around a fractal as a graph of overlapping balls, in which tours are searched.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flight/field/field.h"

namespace mandelmarch {

struct Ball {
    Vector centre;
    double clearance;  // the distance estimate at the centre; the ball's radius is DistanceField::safety() times this
};

// An edge of the graph: a free way from one ball to another.
struct Link {
    int to;        // index of the other ball
    double steps;  // length of the way in clearances; clearances above fastest_clearance() count as that
};

class Balls {
public:
    // Fills a cube with balls whose clearance is at least `least`. The cube's half edge is 1.2 fractal sizes. Some
    // balls may not be connected with the outside; holding() does not return such balls. Points inside the bounds whose
    // clearance is at least `narrow` are collected as narrows(). `coarse`: number of coarse cells along an edge of the
    // cube.
    Balls(const DistanceField& field, double least, double narrow, int coarse = usual_coarse);

    static constexpr int usual_coarse = 64;

    const std::vector<Ball>& balls() const { return balls_; }
    std::span<const Link> links(int ball) const
    {
        const auto number = static_cast<std::size_t>(ball);
        return std::span(links_).subspan(first_link_[number], first_link_[number + 1] - first_link_[number]);
    }

    double least() const { return least_; }

    // Returns a ball that contains p, or -1 if none is known.
    int holding(Vector p) const;

    // Returns free points inside the bounds, including points near the surface. A search for gates can start at them.
    const std::vector<Ball>& narrows() const { return narrows_; }
    void forget_narrows() { narrows_ = {}; }

private:
    struct Cell {
        int x, y, z;
    };
    static constexpr int parts = 4;  // fine cells along the edge of a coarse cell

    std::size_t index(Cell c) const
    {
        const auto along = static_cast<std::size_t>(fine_);
        return (static_cast<std::size_t>(c.z) * along + static_cast<std::size_t>(c.y)) * along +
               static_cast<std::size_t>(c.x);
    }
    Cell cell_of(Vector p) const;
    Vector centre_of(Cell c) const;
    // Calls visit(index) for each fine cell whose centre is at most `radius` from p.
    template <class Visit>
    void each_cell_near(Vector p, double radius, Visit visit) const;

    void flood();
    void cover();
    // Two balls, the first of which has the smaller index, and a way between their centres.
    struct Way {
        int a, b;
        double length;
        double clearance;  // the smallest known estimate on the way
    };
    // Finds pairs of balls that overlap, and pairs with a gap that one ball can fill; gaps have no clearance yet.
    void find_ways(std::vector<Way>& ways, std::vector<Way>& gaps) const;
    void link();
    void keep_outside_component();

    const DistanceField& field_;
    double least_, narrow_;
    int coarse_, fine_;  // numbers of coarse and of fine cells along an edge of the cube
    double half_;        // half the edge of the cube
    double side_;        // edge of a fine cell
    std::vector<Ball> samples_, narrows_;
    std::vector<Ball> balls_;
    std::vector<Link> links_;  // the links of ball 0, then those of ball 1, and so on
    std::vector<std::size_t>
        first_link_;                   // for each ball: index of its first link. The last entry is the number of links
    std::vector<std::int32_t> owner_;  // for each fine cell: index of the ball that covers its centre; -1: none
};

}  // namespace mandelmarch
