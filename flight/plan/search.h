// SPDX-License-Identifier: Apache-2.0
// The search for the next gate, on the roads of shape after shape.
#pragma once

#include <span>
#include <vector>

#include "flight/plan/random.h"
#include "flight/plan/roads.h"

namespace mandelmarch {

// A ball of a stretch's roads, and an entry of a gate: 2 gate + side. -1: none.
struct Node {
    int stretch = 0;
    int ball = -1;
};
struct Entry {
    int stretch = 0;
    int number = -1;
};

class Search {
public:
    // `frames_a_clearance`: how the clock goes.
    Search(std::span<const Stretch> stretches, double frames_a_clearance);

    const Stretch& stretch(int number) const { return stretches_[static_cast<std::size_t>(number)]; }
    const Roads& roads(int stretch) const { return *this->stretch(stretch).roads; }
    const Field& field(int stretch) const { return roads(stretch).field; }
    const Ball& ball(Node node) const { return roads(node.stretch).balls.balls()[static_cast<std::size_t>(node.ball)]; }
    const Gate& gate(Entry entry) const
    {
        return roads(entry.stretch).gates[static_cast<std::size_t>(entry.number) / 2];
    }

    // Dijkstra's search from a ball until enough gates are seen; returns the entry chosen, none if there is none.
    // `done`: the points of the way so far, which should turn little; `clock`: where it stands, frames.
    Entry next(Node from, double clock, std::span<const Vector> done, Random& random);

    // Of the last search: a place inside, some way off; the balls on the way to one; cost (clearances) and clock there.
    Node stroll() const { return stroll_; }
    std::vector<Node> leg_to(Node node) const;
    double cost(Node node) const { return cost_[index(node)]; }
    double clock(Node node) const { return clock_[index(node)]; }

    // Clearances that the turns on the way to a gate cost: from the last way out into the leg, and from the leg into
    // the gate.
    double turn_cost(Node node, Entry entry, std::span<const Vector> done) const;

    // The ball of a stretch that holds the place, or the nearest one that can be flown to; none where there is none.
    Node near(int stretch, Vector place) const;

    // The ball and its neighbours have been flown through, and what holds the place in later shapes.
    void see(Node node);
    // The kind of the gate has been flown; in other shapes those at the same place.
    void mark_flown(Entry entry);
    // A long film begins again.
    void forget();

private:
    std::size_t index(Node node) const
    {
        return offsets_[static_cast<std::size_t>(node.stretch)] + static_cast<std::size_t>(node.ball);
    }

    std::span<const Stretch> stretches_;
    double frames_a_clearance_;
    std::vector<std::size_t> offsets_;      // of each stretch's first ball in what follows
    std::vector<char> seen_;                // balls flown through, and their neighbours
    std::vector<std::vector<char>> flown_;  // of each stretch: kinds of gates
    // Dijkstra's labels, valid where round_ is the current turn.
    std::vector<double> cost_, clock_;
    std::vector<Node> before_;
    std::vector<int> round_;
    int turn_ = 0;
    std::vector<std::vector<int>> entries_;  // of each ball: 2 gate + side
    Node stroll_;
};

}  // namespace mandelmarch
