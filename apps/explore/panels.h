// SPDX-License-Identifier: Apache-2.0
// The panels of the window.
#pragma once

#include <SDL.h>

namespace mandelmarch::explore {

class Explorer;

// Shows all panels that are switched on. Must be called between Window::begin() and Window::draw_panels().
void show_panels(Explorer& explorer);

// The individual panels.
void show_panel(Explorer& explorer);       // view, fractal, backend, export
void show_paths(Explorer& explorer);       // the path, its audit, tours
void show_statistics(Explorer& explorer);  // text over each picture, and messages
void show_help(Explorer& explorer);

// Returns the width in pixels of the panel at the left, or 0 if it is hidden.
float panel_width(const Explorer& explorer);
// Returns the part of the window for pictures, which is to the right of that panel.
SDL_Rect area_beside_panels(const Explorer& explorer);

}  // namespace mandelmarch::explore
