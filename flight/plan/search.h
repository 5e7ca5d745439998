// SPDX-License-Identifier: Apache-2.0
// The search for a tour's next gate, across the roadmaps of successive shapes.
#pragma once

#include <span>
#include <vector>

#include "flight/plan/random.h"
#include "flight/plan/roadmap.h"

namespace mandelmarch {

// A ball of the roadmap of a stretch.
struct Node {
    int stretch = 0;
    int ball = -1;  // -1: none
};
// One side of a gate.
struct Entry {
    int stretch = 0;
    int number = -1;  // 2 gate + side; -1: none
};

class Search {
public:
    // `frames_a_clearance`: shape time per distance.
    Search(std::span<const RoadmapSpan> stretches, double frames_a_clearance);

    const RoadmapSpan& stretch(int number) const { return stretches_[static_cast<std::size_t>(number)]; }
    const Roadmap& roads(int stretch) const { return *this->stretch(stretch).roads; }
    const DistanceField& field(int stretch) const { return roads(stretch).field; }
    const Ball& ball(Node node) const { return roads(node.stretch).balls.balls()[static_cast<std::size_t>(node.ball)]; }
    const Gate& gate(Entry entry) const
    {
        return roads(entry.stretch).gates[static_cast<std::size_t>(entry.number) / 2];
    }

    // Chooses the next gate by Dijkstra's search from a ball, until enough gates are found. Returns an empty entry if
    // no gate is in reach. `clock`: the shape time at the ball, frames. `done`: the points of the tour so far, relative
    // to which turns have a cost.
    Entry next(Node from, double clock, std::span<const Vector> done, FlightRandom& random);

    // Results of the last search. stroll(): the fallback, a ball inside at some distance; leg_to(): the balls on the
    // path to a node; cost() and clock(): clearances and shape time at a node.
    Node stroll() const { return stroll_; }
    std::vector<Node> leg_to(Node node) const;
    double cost(Node node) const { return cost_[index(node)]; }
    double clock(Node node) const { return clock_[index(node)]; }

    // Returns the cost, in clearances, of two turns: from the tour so far into the leg to a gate, and from the leg into
    // the gate.
    double turn_cost(Node node, Entry entry, std::span<const Vector> done) const;

    // Returns the ball of a stretch that contains the place, else the nearest one with a free way to it; -1 if none.
    Node near(int stretch, Vector place) const;

    // Marks the ball, its neighbours, and the balls at its place in later shapes as visited.
    void see(Node node);
    // Marks the gate's kind, and the kinds of gates at the same place in other shapes, as flown.
    void mark_flown(Entry entry);
    // Clears the marks of see() and mark_flown().
    void forget();

private:
    std::size_t index(Node node) const
    {
        return offsets_[static_cast<std::size_t>(node.stretch)] + static_cast<std::size_t>(node.ball);
    }

    std::span<const RoadmapSpan> stretches_;
    double frames_a_clearance_;
    std::vector<std::size_t> offsets_;      // for each stretch: its first ball's index in vectors of all balls
    std::vector<char> seen_;                // for each ball: visited, or a neighbour of a visited one
    std::vector<std::vector<char>> flown_;  // for each stretch and kind of gate
    // Dijkstra's labels for each ball, valid where round_ equals turn_.
    std::vector<double> cost_, clock_;
    std::vector<Node> before_;
    std::vector<int> round_;
    int turn_ = 0;
    std::vector<std::vector<int>> entries_;  // for each ball: its gates' entries, 2 gate + side
    Node stroll_;
};

}  // namespace mandelmarch
