// SPDX-License-Identifier: Apache-2.0
// The search for a tour's next gate, across the roadmaps of successive shapes.
#pragma once

#include <compare>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "flight/route/random.h"
#include "flight/route/roadmap.h"

namespace mandelmarch {

// A ball of the roadmap of a stretch of time (RoadmapSpan).
struct Node {
    int stretch = 0;
    int ball = -1;  // index of the ball; -1: none

    auto operator<=>(const Node&) const = default;  // NOLINT(modernize-use-nullptr): clang-tidy 14 misreads <=>
};
// One side of a gate, from which a tour can enter the gate.
struct Entry {
    int stretch = 0;
    int number = -1;  // 2 * (index of the gate) + (side: 0 or 1); -1: none
};

class Search {
public:
    // `frames_a_clearance`: shape time that passes on a way of one clearance, in frames; 0 if the shape does not
    // change.
    Search(std::span<const RoadmapSpan> stretches, double frames_a_clearance);

    const RoadmapSpan& stretch(int number) const { return stretches_[static_cast<std::size_t>(number)]; }
    const Roadmap& roads(int stretch) const { return *this->stretch(stretch).roads; }
    const DistanceField& field(int stretch) const { return roads(stretch).field; }
    const Ball& ball(Node node) const { return roads(node.stretch).balls.balls()[static_cast<std::size_t>(node.ball)]; }
    const Gate& gate(Entry entry) const
    {
        return roads(entry.stretch).gates[static_cast<std::size_t>(entry.number) / 2];
    }

    // Chooses the next gate among the closest ones, which are found by Dijkstra's search from the ball `from`. Returns
    // an empty entry if no gate is in reach. `clock`: the shape time when the tour reaches the ball, that is, the frame
    // of the schedule that gives the fractal its shape. `heading`: the direction of the tour so far; zero if it is
    // unknown. The cost of a gate includes the turn from this direction to the way to the gate.
    Entry next(Node from, double clock, Vector heading, FlightRandom& random);

    // Searches the cheapest way from one ball of stretch 0 to another. Returns true if there is one. Only for a shape
    // that does not change.
    bool find(Node from, Node to);

    // These functions return results of the last search, stroll() those of the last next():
    // - stroll(): a ball inside the bounds at some distance, to which the tour can lead if there is no gate,
    // - leg_to(): the balls on the way to a node,
    // - cost() and clock(): the cost of that way in clearances, and the shape time at the node.
    Node stroll() const { return stroll_; }
    std::vector<Node> leg_to(Node node) const;
    double cost(Node node) const { return states_[index(node)].cost; }
    double clock(Node node) const { return states_[index(node)].clock; }

    // Returns the cost, in clearances, of the turns at both ends of the leg to a gate: from the direction `heading`
    // into the leg, and from the leg into the gate.
    double turn_cost(Node node, Entry entry, Vector heading) const;

    // Returns true if the straight way between two places is free and wide enough for a tour in this stretch.
    bool is_free(int stretch, Vector from, Vector to) const;

    // Returns the ball of a stretch that contains the place. If no ball contains the place, returns a close ball with a
    // free way to the place or, if there is no such ball, an empty node.
    Node near(int stretch, Vector place) const;

    // Marks a ball and the balls linked to it as visited. In each later stretch, does the same for the ball at the same
    // place.
    void see(Node node);
    // Marks the gate's kind, and the kinds of gates at the same place in other shapes, as flown.
    void mark_flown(Entry entry);
    // Clears the marks of see() and mark_flown().
    void forget();

private:
    using Label = std::pair<double, Node>;  // cost, and the ball that it leads to
    using Queue = std::priority_queue<Label, std::vector<Label>, std::greater<>>;

    // Sets the labels of a ball and queues it, unless this search has found a way of at most the same cost.
    void relax(Queue& queue, Node node, double cost, double clock, Node before);
    // Returns the number of entries after which next() ends: `choices` or, if the shape does not change, the number of
    // entries of gates that are not flown, if it is smaller. A search without this limit would find the same entries.
    int left() const;
    // Returns the cost of a link to the ball `to`, from its length in clearances.
    double with_penalties(double steps, Node to) const;

    std::size_t index(Node node) const
    {
        return offsets_[static_cast<std::size_t>(node.stretch)] + static_cast<std::size_t>(node.ball);
    }

    std::span<const RoadmapSpan> stretches_;
    double frames_a_clearance_;
    std::vector<std::size_t> offsets_;      // for each stretch: index of its first ball in the vectors of all balls
    std::vector<std::vector<char>> flown_;  // for each stretch and kind of gate: marked by mark_flown()
    // A ball and Dijkstra's labels for it. They are stored together, because the search visits the balls in no order
    // and waits for memory.
    struct alignas(32) State {
        bool outside;        // the ball's centre is outside the bounds
        bool entry = false;  // entries of gates begin in it
        bool seen = false;   // marked by see()
        int round = -1;      // the labels belong to the last search if this equals turn_
        double cost = 0, clock = 0;
        Node before = {};
    };
    std::vector<State> states_;
    int turn_ = 0;
    std::vector<std::vector<int>> entries_;  // for each ball: the entries of gates that begin in it, see Entry::number
    Node stroll_;
};

}  // namespace mandelmarch
