// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/view/panes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/os/stopwatch.h"
#include "flight/path/path.h"

namespace mandelmarch::explore {
namespace {

constexpr double again = 1;                          // seconds until a failed pane is rendered again
constexpr double long_silence = 3;                   // seconds without progress after which trouble() reports it
constexpr double short_silence = 1;                  // seconds without progress after which a request that is
                                                     // no longer needed is abandoned
constexpr int gap = 2;                               // pixels between panes
constexpr std::uint32_t mark_visible = 0xFFFF00FFU;  // colour of pixels that differ by more than 2 of 255
constexpr std::uint32_t mark_any = 0xFFFFFF00U;      // colour of other pixels that differ
constexpr int visible = 2;                           // largest invisible difference of bytes (core/image/compare.h)

// Returns the scene as a film of its size shows it: without details that are smaller than a pixel, which flicker.
Scene in_motion(const Scene& scene)
{
    const Frame frame{scene.eye, scene.target, scene.up, scene.field_of_view, {}};
    Scene moving = picture_of({.scene = scene, .frames = {}}, frame, scene.width, scene.height);
    moving.detail = std::max(moving.detail, scene.detail);
    moving.iterations = scene.iterations;
    moving.centred = true;
    return moving;
}

}  // namespace

Panes::Panes(const Registry& registry, const Setup& setup) : render_thread_(registry) { arrange({setup}, area_); }

void Panes::arrange(const std::vector<Setup>& setups, const SDL_Rect& area)
{
    area_ = area;
    panes_.resize(setups.size());
    for (std::size_t i = 0; i < setups.size(); ++i) set(panes_[i], setups[i]);
}

void Panes::set(Pane& pane, const Setup& setup)
{
    if (pane.setup == setup) return;
    pane.setup = setup;
    pane.resolution.forget();
    pane.view = pane.whole_view = 0;
    pane.failure.clear();
    pane.failed_at = {};
    pane.compared.reset();
    render_thread_.cancel();
    if (render_thread_.silence() > short_silence) render_thread_.abandon();
}

SDL_Rect Panes::place(std::size_t number) const
{
    const int columns = panes_.size() > 1 ? 2 : 1;
    const int rows = panes_.size() > 2 ? 2 : 1;
    const int column = static_cast<int>(number) % columns;
    const int row = static_cast<int>(number) / columns;
    const auto edge = [](int side, int count, int at) { return at * (side + gap) / count; };
    // All panes have the size of the first one, so that their pictures can be compared.
    return {area_.x + edge(area_.w, columns, column), area_.y + edge(area_.h, rows, row),
            std::max(1, edge(area_.w, columns, 1) - gap), std::max(1, edge(area_.h, rows, 1) - gap)};
}

void Panes::set_view(const Scene& scene, std::uint64_t version, bool marks)
{
    scene_ = scene;
    view_ = version;
    marks_ = marks;
    const RenderRequest* current = render_thread_.current();
    if (current != nullptr && !current->moving && current->view != version) render_thread_.cancel();
}

bool Panes::waits_after_failure(const Pane& pane) const
{
    return !pane.failure.empty() && (pane.view == view_ || seconds_since(pane.failed_at) < again);
}

std::optional<RenderRequest> Panes::next(bool moving, double budget) const
{
    const SDL_Rect whole = place(0);
    const auto order = [&](std::size_t number, int samples, int width, int height) {
        RenderRequest made{static_cast<int>(number), view_, panes_[number].setup, scene_, samples, moving};
        made.scene.width = width;
        made.scene.height = height;
        if (moving) made.scene = in_motion(made.scene);
        return made;
    };
    if (moving) {
        const double each = budget / static_cast<double>(panes_.size());
        for (std::size_t i = 0; i < panes_.size(); ++i) {
            if (panes_[i].view == view_ || waits_after_failure(panes_[i])) continue;
            const auto [width, height] = panes_[i].resolution.size(whole.w, whole.h, each);
            return order(i, 1, width, height);
        }
        return std::nullopt;
    }
    for (const int samples : samples_at_rest) {
        if (samples > last_samples()) break;
        for (std::size_t i = 0; i < panes_.size(); ++i) {
            if (waits_after_failure(panes_[i])) continue;
            const bool there = panes_[i].view == view_ && panes_[i].samples >= samples;
            if (!there) return order(i, samples, whole.w, whole.h);
        }
    }
    return std::nullopt;
}

bool Panes::missing() const
{
    return std::ranges::any_of(panes_, [&](const Pane& pane) {
        return pane.view != view_ || (pane.samples < last_samples() && pane.failure.empty());
    });
}

void Panes::work(SDL_Renderer* renderer, bool moving, double budget, Moment until)
{
    // Abandons an obsolete request if its device does not respond.
    if (const RenderRequest* current = render_thread_.current();
        current != nullptr && render_thread_.silence() > short_silence) {
        const auto pane = static_cast<std::size_t>(current->pane);
        if (pane >= panes_.size() || panes_[pane].setup != current->setup) render_thread_.abandon();
    }
    for (;;) {
        if (render_thread_.current() == nullptr) {
            auto order = next(moving, budget);
            if (!order) return;
            render_thread_.draw(std::move(*order));
        }
        auto drawn = render_thread_.wait(until);
        if (!drawn) return;
        accept(renderer, std::move(*drawn));
    }
}

void Panes::accept(SDL_Renderer* renderer, RenderedPicture drawn)
{
    const RenderRequest& order = drawn.order;
    if (drawn.cancelled || static_cast<std::size_t>(order.pane) >= panes_.size()) return;
    Pane& pane = panes_[static_cast<std::size_t>(order.pane)];
    if (pane.setup != order.setup) return;
    if (!drawn.failure.empty()) {
        pane.failure = drawn.failure;
        pane.failed_at = Clock::now();
        pane.view = order.view;
        pane.samples = 0;
        return;
    }
    pane.failure.clear();
    const double pixels = static_cast<double>(order.scene.width) * order.scene.height * order.samples * order.samples;
    if (order.moving) pane.resolution.took(pixels, drawn.seconds);
    const SDL_Rect whole = place(0);
    pane.view = order.view;
    pane.samples = order.moving ? 0 : order.samples;
    pane.share = std::min(
        1.0, static_cast<double>(order.scene.width) * order.scene.height / (static_cast<double>(whole.w) * whole.h));
    pane.seconds = drawn.seconds;
    pane.report = std::move(drawn.report);
    update(pane.texture, renderer, drawn.pixels);
    pane.compared.reset();
    if (order.moving || order.samples > 1) return;
    pane.whole = std::move(drawn.image);
    pane.whole_view = order.view;
    if (panes_.size() > 1) mark(renderer);
}

void Panes::mark(SDL_Renderer* renderer)
{
    const Pane& first = panes_.front();
    if (first.whole_view != view_) return;
    const Pixels expected = pixels_of(first.whole);
    for (std::size_t i = 1; i < panes_.size(); ++i) {
        Pane& pane = panes_[i];
        if (pane.whole_view != view_ || pane.whole.width() != first.whole.width() ||
            pane.whole.height() != first.whole.height()) {
            continue;
        }
        pane.compared = compare(first.whole, pane.whole);
        Pixels pixels = pixels_of(pane.whole);
        for (std::size_t at = 0; marks_ && at < pixels.of.size(); ++at) {
            std::uint32_t& pixel = pixels.of[at];
            int most = 0;
            for (int shift = 0; shift < 24; shift += 8) {
                const auto byte = [shift](std::uint32_t of) { return static_cast<int>(of >> shift & 0xFF); };
                most = std::max(most, std::abs(byte(expected.of[at]) - byte(pixel)));
            }
            // Equal pixels are darkened.
            pixel = most > visible ? mark_visible : most > 0 ? mark_any : (pixel >> 1 & 0x7F7F7F) | 0xFF000000U;
        }
        update(pane.texture, renderer, pixels);
    }
}

std::string Panes::trouble() const
{
    const RenderRequest* current = render_thread_.current();
    if (current == nullptr || render_thread_.silence() < long_silence) return {};
    return fmt::format("{}: no progress for {:.0f} s; you can choose another backend", name_of(current->setup),
                       render_thread_.silence());
}

}  // namespace mandelmarch::explore
