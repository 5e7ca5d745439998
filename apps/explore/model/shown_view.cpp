// SPDX-License-Identifier: Apache-2.0
#include "apps/explore/model/shown_view.h"

#include <algorithm>

namespace mandelmarch::explore {

void ShownView::set(const Scene& scene)
{
    const auto [width, height] = std::pair(now_.scene.width, now_.scene.height);
    now_.scene = scene;
    now_.scene.width = width;
    now_.scene.height = height;
    changed();
}

void ShownView::set_size(int width, int height)
{
    if (now_.scene.width == width && now_.scene.height == height) return;
    now_.scene.width = width;
    now_.scene.height = height;
    changed();
}

void ShownView::set(const Setup& setup)
{
    now_.setups.at(chosen_) = setup;
    changed();
}

void ShownView::set_count(std::size_t count)
{
    now_.setups.resize(count, now_.setups.front());
    chosen_ = std::min(chosen_, count - 1);
    changed();
}

void ShownView::remember()
{
    constexpr std::size_t most = 500;
    past_.push_back(now_);
    if (past_.size() > most) past_.erase(past_.begin());
    future_.clear();
}

bool ShownView::restore(std::vector<State>& from, std::vector<State>& to)
{
    if (from.empty()) return false;
    to.push_back(now_);
    set(from.back().scene);
    now_.setups = from.back().setups;
    chosen_ = std::min(chosen_, now_.setups.size() - 1);
    from.pop_back();
    return true;
}

}  // namespace mandelmarch::explore
