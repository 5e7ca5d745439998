// SPDX-License-Identifier: Apache-2.0
// The view that the window shows: a scene and the setups that render it side by side, with undo.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "apps/explore/model/setup.h"

namespace mandelmarch::explore {

inline constexpr int most_panes = 4;

class ShownView {
public:
    ShownView(const Scene& scene, const Setup& setup) : now_{scene, {setup}} {}

    // Returns the scene. Its size is that of a pane, in pixels.
    const Scene& scene() const { return now_.scene; }
    // Returns one setup per pane.
    const std::vector<Setup>& setups() const { return now_.setups; }
    // The pane whose setup the user changes.
    std::size_t chosen() const { return chosen_; }
    const Setup& setup() const { return now_.setups.at(chosen_); }
    // Returns a number that grows with each change. The panes are then rendered again.
    std::uint64_t version() const { return version_; }

    // Replaces the scene, except its size.
    void set(const Scene& scene);
    void set_size(int width, int height);
    // Replaces the chosen pane's setup.
    void set(const Setup& setup);
    // Removes the last panes, or adds panes with the first one's setup.
    void set_count(std::size_t count);
    void choose(std::size_t pane) { chosen_ = pane % now_.setups.size(); }
    void changed() { ++version_; }

    // Saves scene and setups, so that undo() can restore them. Called before a change.
    void remember();
    // Return false if there is nothing to restore.
    bool undo() { return restore(past_, future_); }
    bool redo() { return restore(future_, past_); }

private:
    struct State {
        Scene scene;
        std::vector<Setup> setups;
    };

    bool restore(std::vector<State>& from, std::vector<State>& to);

    State now_;
    std::vector<State> past_, future_;
    std::size_t chosen_ = 0;
    std::uint64_t version_ = 1;
};

}  // namespace mandelmarch::explore
