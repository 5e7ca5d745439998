// SPDX-License-Identifier: Apache-2.0
// The free space as overlapping balls. Tours are searched in this graph.
#pragma once

#include <cstdint>
#include <vector>

#include "flight/field/field.h"

namespace mandelmarch {

struct Ball {
    Vector centre;
    double clearance;  // the distance estimate at the centre; the ball's radius is safety times this
};

struct Link {
    int to;
    double length;     // between the centres
    double clearance;  // the smallest known estimate between the centres
};

class Balls {
public:
    // Fills the free space that is connected with the outside with balls of at least `least` clearance, within a cube
    // whose half edge is 1.2 fractal sizes. Free points inside the bounds of at least `narrow` clearance are kept as
    // narrows(). `coarse`: cells of the coarse grid along an edge.
    Balls(const DistanceField& field, double least, double narrow, int coarse = usual_coarse);

    static constexpr int usual_coarse = 64;

    const std::vector<Ball>& balls() const { return balls_; }
    const std::vector<Link>& links(int ball) const { return links_[static_cast<std::size_t>(ball)]; }

    double least() const { return least_; }

    // Returns a ball that contains p, or -1 if none is known.
    int holding(Vector p) const;

    // Free points inside the bounds, including those near the surface, at which a search for gates can start.
    const std::vector<Ball>& narrows() const { return narrows_; }
    void forget_narrows() { narrows_ = {}; }

private:
    struct Cell {
        int x, y, z;
    };
    static constexpr int parts = 4;  // fine cells along the edge of a coarse one

    std::size_t index(Cell c) const
    {
        const auto along = static_cast<std::size_t>(fine_);
        return (static_cast<std::size_t>(c.z) * along + static_cast<std::size_t>(c.y)) * along +
               static_cast<std::size_t>(c.x);
    }
    Cell cell_of(Vector p) const;
    Vector centre_of(Cell c) const;
    // Calls visit(index) for the fine cells whose centres lie within `radius` of p.
    template <class Visit>
    void each_cell_near(Vector p, double radius, Visit visit) const;

    void flood();
    void cover();
    void link();
    void keep_outside_component();

    const DistanceField& field_;
    double least_, narrow_;
    int coarse_, fine_;  // cells along an edge
    double half_;        // half the edge of the cube
    double side_;        // of a fine cell
    std::vector<Ball> samples_, narrows_;
    std::vector<Ball> balls_;
    std::vector<std::vector<Link>> links_;
    std::vector<std::int32_t> owner_;  // for each fine cell: the ball that covers its centre, -1: none
};

}  // namespace mandelmarch
