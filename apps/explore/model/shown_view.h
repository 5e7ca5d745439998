// SPDX-License-Identifier: Apache-2.0
// The view that the window shows: a scene and the setups that render it side by side, with undo.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <numbers>
#include <vector>

#include "apps/explore/model/files.h"

namespace mandelmarch::explore {

inline constexpr int most_panes = 4;

class ShownView {
public:
    ShownView(const Scene& scene, const Setup& setup) : now_{scene, {setup}} {}

    // Returns the scene. Its size is that of a pane, in pixels.
    const Scene& scene() const { return now_.scene; }
    // Returns the scene as a pane shows it. The field of view is larger than that of scene() if the pane is narrower
    // than the whole area for pictures, so that the pane shows the whole width of a picture that fills the area.
    Scene shown() const
    {
        Scene scene = now_.scene;
        const double aspect = static_cast<double>(scene.width) / scene.height;
        if (aspect >= whole_aspect_) return scene;
        constexpr double half = degrees_per_field / 2 * std::numbers::pi / 180;  // radians per unit of field of view
        scene.field_of_view = std::atan(whole_aspect_ / aspect * std::tan(half * scene.field_of_view)) / half;
        return scene;
    }
    // Returns one setup per pane.
    const std::vector<Setup>& setups() const { return now_.setups; }
    // Returns the index of the pane whose setup the user changes.
    std::size_t chosen() const { return chosen_; }
    const Setup& setup() const { return now_.setups.at(chosen_); }
    // Returns a number that grows with each change. The panes are rendered again whenever this number has grown.
    std::uint64_t version() const { return version_; }

    // Replaces the scene, except its size.
    void set(Scene scene)
    {
        scene.width = now_.scene.width;
        scene.height = now_.scene.height;
        now_.scene = std::move(scene);
        changed();
    }

    // Sets the size of a pane in pixels. `whole_aspect`: width / height of the whole area for pictures.
    void set_size(int width, int height, double whole_aspect)
    {
        if (now_.scene.width == width && now_.scene.height == height && whole_aspect_ == whole_aspect) return;
        now_.scene.width = width;
        now_.scene.height = height;
        whole_aspect_ = whole_aspect;
        changed();
    }

    // Replaces the chosen pane's setup.
    void set(const Setup& setup)
    {
        now_.setups.at(chosen_) = setup;
        changed();
    }

    // Removes the last panes, or adds panes with the first pane's setup, until there are `count` panes.
    void set_count(std::size_t count)
    {
        now_.setups.resize(count, now_.setups.front());
        chosen_ = std::min(chosen_, count - 1);
        changed();
    }

    void choose(std::size_t pane) { chosen_ = pane % now_.setups.size(); }
    void changed() { ++version_; }

    // Saves scene and setups, so that undo() can restore them. Called before a change.
    void remember()
    {
        constexpr std::size_t most = 500;
        past_.push_back(now_);
        if (past_.size() > most) past_.pop_front();
        future_.clear();
    }

    // Restores the state before the last change. redo() restores the state before the last undo(). Both return false if
    // there is no such state.
    bool undo() { return restore(past_, future_); }
    bool redo() { return restore(future_, past_); }

private:
    struct State {
        Scene scene;
        std::vector<Setup> setups;
    };

    bool restore(std::deque<State>& from, std::deque<State>& to)
    {
        if (from.empty()) return false;
        to.push_back(now_);
        now_.setups = from.back().setups;
        chosen_ = std::min(chosen_, now_.setups.size() - 1);
        set(std::move(from.back().scene));
        from.pop_back();
        return true;
    }

    State now_;
    std::deque<State> past_, future_;
    std::size_t chosen_ = 0;
    double whole_aspect_ = 0;
    std::uint64_t version_ = 1;
};

}  // namespace mandelmarch::explore
