// SPDX-License-Identifier: Apache-2.0
// The panels of the window. They are shown between Window::begin() and Window::draw_panels().
#pragma once

#include <SDL.h>

#include "apps/explore/actions/actions.h"
#include "apps/explore/view/panes.h"

namespace mandelmarch::explore {

// Shows the panel at the left: view, fractal, backend. `focus`: true to move the keyboard to the panel.
void show_panel(Model& model, float width, bool focus);

// Returns the width of the panel at the left. `window_width`: the window's width. Both are in pixels.
float panel_width(int window_width);

// Shows the panel for paths, and tours. `left`: width of the panel at the left, in pixels.
void show_paths(Model& model, float left);

// Shows statistics and warnings over each picture, and messages. `area`: the part of the window for pictures.
// `clearance`: the distance estimate at the eye.
void show_overlay(const Model& model, const Panes& panes, const SDL_Rect& area, double clearance);

void show_help(Model& model);

}  // namespace mandelmarch::explore
