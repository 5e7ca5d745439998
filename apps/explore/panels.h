// SPDX-License-Identifier: Apache-2.0
// The panels over the pictures.
#pragma once

#include <SDL.h>

namespace mandelmarch::explore {

class Explorer;

// Shows all visible panels. Must be called between Window::begin() and Window::draw_panels().
void show_panels(Explorer& explorer);

// The individual panels.
void show_panel(Explorer& explorer);       // view, fractal, backend, export
void show_paths(Explorer& explorer);       // the path, its audit, tours
void show_statistics(Explorer& explorer);  // a line in each picture
void show_help(Explorer& explorer);

// Returns the panel's width in pixels, or 0 if it is hidden.
float panel_width(const Explorer& explorer);
// Returns the part of the window for pictures.
SDL_Rect area_beside_panels(const Explorer& explorer);

}  // namespace mandelmarch::explore
