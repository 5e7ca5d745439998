// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/panes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/stopwatch.h"

namespace mandelmarch::explore {
namespace {

constexpr double again = 1;                          // seconds until a failed pane is rendered again
constexpr double long_silence = 3;                   // seconds without progress after which trouble() reports it
constexpr double short_silence = 1;                  // seconds without progress after which a request that is
                                                     // no longer needed is abandoned
constexpr int gap = 2;                               // pixels between panes
constexpr std::uint32_t mark_visible = 0xFFFF00FFU;  // colour of pixels that differ by more than 2 of 255
constexpr std::uint32_t mark_any = 0xFFFFFF00U;      // colour of other pixels that differ
constexpr int visible = 2;                           // threshold of core/image/compare.h, in bytes of 0 to 255

}  // namespace

Panes::Panes(const Registry& registry, const Setup& setup) : render_thread_(registry)
{
    panes_.push_back(std::make_unique<Pane>());
    panes_.front()->setup = setup;
}

void Panes::set_count(std::size_t count)
{
    while (panes_.size() > count) panes_.pop_back();
    while (panes_.size() < count) {
        panes_.push_back(std::make_unique<Pane>());
        panes_.back()->setup = panes_.front()->setup;
    }
    choose(std::min(chosen_, count - 1));
}

void Panes::set(Pane& pane, const Setup& setup)
{
    if (pane.setup == setup) return;
    // The old picture remains visible until the new one is complete.
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

void Panes::look(const Scene& scene, std::uint64_t view, const SDL_Rect& area)
{
    scene_ = scene;
    view_ = view;
    area_ = area;
    const RenderRequest* current = render_thread_.current();
    if (current != nullptr && !current->moving && current->view != view) render_thread_.cancel();
}

bool Panes::waits_after_failure(const Pane& pane) const
{
    return !pane.failure.empty() && (pane.view == view_ || seconds_since(pane.failed_at) < again);
}

std::optional<RenderRequest> Panes::next(bool moving, double budget) const
{
    const SDL_Rect whole = place(0);
    const auto order = [&](std::size_t number, int samples, int width, int height) {
        RenderRequest made{static_cast<int>(number), view_, panes_[number]->setup, scene_, samples, moving};
        made.scene.width = width;
        made.scene.height = height;
        if (moving) made.scene.centred = true;
        return made;
    };
    if (moving) {
        const double each = budget / static_cast<double>(panes_.size());
        for (std::size_t i = 0; i < panes_.size(); ++i) {
            if (panes_[i]->view == view_ || waits_after_failure(*panes_[i])) continue;
            const auto [width, height] = panes_[i]->resolution.size(whole.w, whole.h, each);
            return order(i, 1, width, height);
        }
        return std::nullopt;
    }
    for (const int samples : samples_at_rest) {
        if (samples > last_samples()) break;
        for (std::size_t i = 0; i < panes_.size(); ++i) {
            if (waits_after_failure(*panes_[i])) continue;
            const bool there = panes_[i]->view == view_ && panes_[i]->samples >= samples;
            if (!there) return order(i, samples, whole.w, whole.h);
        }
    }
    return std::nullopt;
}

bool Panes::missing() const
{
    return std::ranges::any_of(panes_, [&](const auto& pane) {
        return pane->view != view_ || (pane->samples < last_samples() && pane->failure.empty());
    });
}

void Panes::work(SDL_Renderer* renderer, bool moving, double budget, Moment until)
{
    // Abandons an obsolete request if its device does not respond.
    if (const RenderRequest* current = render_thread_.current();
        current != nullptr && render_thread_.silence() > short_silence) {
        const auto pane = static_cast<std::size_t>(current->pane);
        if (pane >= panes_.size() || panes_[pane]->setup != current->setup) render_thread_.abandon();
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
    Pane& pane = *panes_[static_cast<std::size_t>(order.pane)];
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
    pane.sheet.take(renderer, drawn.pixels);
    pane.compared.reset();
    if (order.moving || order.samples > 1) return;
    pane.whole = std::move(drawn.image);
    pane.whole_view = order.view;
    if (panes_.size() > 1) mark(renderer);
}

void Panes::mark(SDL_Renderer* renderer)
{
    const Pane& first = *panes_.front();
    if (first.whole_view != view_) return;
    for (std::size_t i = 1; i < panes_.size(); ++i) {
        Pane& pane = *panes_[i];
        if (pane.whole_view != view_ || pane.whole.width() != first.whole.width() ||
            pane.whole.height() != first.whole.height()) {
            continue;
        }
        pane.compared = compare(first.whole, pane.whole);
        Pixels pixels = pixels_of(pane.whole);
        const std::size_t width = static_cast<std::size_t>(pixels.width);
        const std::size_t height = static_cast<std::size_t>(pixels.height);
        for (std::size_t at = 0; marks && at < pixels.of.size(); ++at) {
            // Row 0 of a picture is at the bottom, row 0 of the window at the top.
            const std::size_t byte = 3 * ((height - 1 - at / width) * width + at % width);
            int most = 0;
            for (std::size_t c = byte; c < byte + 3; ++c) {
                most = std::max(most, std::abs(first.whole.bytes()[c] - pane.whole.bytes()[c]));
            }
            // Equal pixels are darkened.
            pixels.of[at] = most > visible ? mark_visible
                            : most > 0     ? mark_any
                                           : (pixels.of[at] >> 1 & 0x7F7F7F) | 0xFF000000U;
        }
        pane.sheet.take(renderer, pixels);
    }
}

std::string Panes::trouble() const
{
    const RenderRequest* current = render_thread_.current();
    if (current == nullptr || render_thread_.silence() < long_silence) return {};
    return fmt::format("{}: no sign of life for {:.0f} s; another backend can be chosen", name_of(current->setup),
                       render_thread_.silence());
}

}  // namespace mandelmarch::explore
