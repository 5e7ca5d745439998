// SPDX-License-Identifier: Apache-2.0
// The pictures of one view, side by side where there are several: who draws each, how far it is, and where it differs
// from the first one.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/explore/pace.h"
#include "apps/explore/painter.h"
#include "apps/explore/window.h"
#include "core/image/compare.h"

namespace mandelmarch::explore {

inline constexpr int most_panes = 4;
inline constexpr std::array samples_at_rest{1, 2, 4};  // on a side of a pixel, one after the other

struct Pane {
    Setup setup;
    Pace pace;
    Sheet sheet;
    std::uint64_t view = 0;  // that it shows
    int samples = 0;         // on a side of a pixel; 0: of a moving picture
    double share = 0;        // of the pane's pixels that the picture has
    Image whole;             // the view's picture at rest, for comparing and keeping
    std::uint64_t whole_view = 0;
    std::optional<Comparison> compared;  // with the first pane's
    RenderReport report;
    double seconds = 0;
    std::string failure;
    Moment failed_at{};
};

class Panes {
public:
    Panes(const Registry& registry, const Setup& setup);

    const std::vector<std::unique_ptr<Pane>>& all() const { return panes_; }
    Pane& chosen() { return *panes_.at(chosen_); }
    std::size_t chosen_number() const { return chosen_; }
    void choose(std::size_t number) { chosen_ = number % panes_.size(); }
    void set_count(std::size_t count);
    void set(Pane& pane, const Setup& setup);

    bool marks = true;  // differing pixels are marked

    // Where pane `number` stands in the window.
    SDL_Rect place(std::size_t number) const;

    // Another view, or another part of the window: everything is to be drawn anew. The scene's size means nothing.
    void look(const Scene& scene, std::uint64_t view, const SDL_Rect& area);
    // Draws until then at the latest. `moving`: pictures that are there in `budget` seconds; else whole ones, then
    // those of more samples, and returns at once where nothing is there. True where a picture has come.
    bool work(SDL_Renderer* renderer, bool moving, double budget, Moment until);
    // True while something is missing at rest.
    bool missing() const;
    // What the drawing thread is at, for the user: "", or a line.
    std::string trouble() const;
    double progress() const { return painter_.progress(); }
    bool drawing() const { return painter_.current() != nullptr; }

private:
    std::optional<Order> next(bool moving, double budget) const;
    void accept(SDL_Renderer* renderer, Drawn drawn);
    void mark(SDL_Renderer* renderer);
    int last_samples() const { return panes_.size() > 1 ? 1 : samples_at_rest.back(); }
    bool waits_after_failure(const Pane& pane) const;

    Painter painter_;
    std::vector<std::unique_ptr<Pane>> panes_;
    std::size_t chosen_ = 0;
    Scene scene_;
    std::uint64_t view_ = 0;
    SDL_Rect area_{0, 0, 1, 1};
};

}  // namespace mandelmarch::explore
