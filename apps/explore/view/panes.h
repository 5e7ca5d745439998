// SPDX-License-Identifier: Apache-2.0
// Panes: up to four pictures of one view side by side. Each picture is rendered with its own setup. The second to
// fourth pictures are compared with the first one.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/explore/view/render_thread.h"
#include "apps/explore/view/resolution_control.h"
#include "apps/explore/view/window.h"
#include "core/image/compare.h"

namespace mandelmarch::explore {

// Samples per pixel side of pictures for which the camera is at rest, in the order of rendering. If there is more than
// one pane, only the first number is used.
inline constexpr std::array samples_at_rest{1, 2, 4};

struct Pane {
    Setup setup;
    ResolutionControl resolution;
    Texture texture{nullptr, SDL_DestroyTexture};
    std::uint64_t view = 0;              // version of the view that the picture shows
    int samples = 0;                     // per pixel side; 0: rendered while the camera moved
    double share = 0;                    // number of the picture's pixels, as a fraction of the pane's pixels
    Image whole;                         // the last picture at rest with one sample per pixel, for comparison
    std::uint64_t whole_view = 0;        // version of the view that `whole` shows
    std::optional<Comparison> compared;  // comparison of `whole` with that of the first pane
    RenderStats report;
    double seconds = 0;   // render time of the picture
    std::string failure;  // error message of the last attempt; empty: success
    Moment failed_at{};
};

class Panes {
public:
    Panes(const Registry& registry, const Setup& setup);

    const std::vector<Pane>& all() const { return panes_; }

    // Sets the panes' setups and the part of the window for pictures. A pane with a new setup is rendered again; its
    // old picture remains visible until then.
    void arrange(const std::vector<Setup>& setups, const SDL_Rect& area);
    // Returns the rectangle of pane `number` in the window.
    SDL_Rect place(std::size_t number) const;

    // Sets the view and its version. All panes are rendered again if the version is new. The scene's size is unused.
    // `marks`: pixels that differ from the first pane are marked.
    void set_view(const Scene& scene, std::uint64_t version, bool marks);
    // Renders the missing pictures. Returns at the time `until` at the latest. `moving`: the camera moves. In this
    // case, chooses the pictures' size so that all of them together take `budget` seconds. Otherwise renders each
    // picture at full size, first with the fewest samples per pixel of samples_at_rest, then with more.
    void work(SDL_Renderer* renderer, bool moving, double budget, Moment until);
    // Returns true if a picture at rest is still missing.
    bool missing() const;
    // Returns a message if a device has not responded for three seconds, else "".
    std::string trouble() const;
    bool drawing() const { return render_thread_.current() != nullptr; }

private:
    std::optional<RenderRequest> next(bool moving, double budget) const;
    void set(Pane& pane, const Setup& setup);
    void accept(SDL_Renderer* renderer, RenderedPicture drawn);
    void mark(SDL_Renderer* renderer);
    int last_samples() const { return panes_.size() > 1 ? 1 : samples_at_rest.back(); }
    bool waits_after_failure(const Pane& pane) const;

    RenderThread render_thread_;
    std::vector<Pane> panes_;
    Scene scene_;
    std::uint64_t view_ = 0;
    bool marks_ = true;
    SDL_Rect area_{0, 0, 1, 1};
};

}  // namespace mandelmarch::explore
